// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/drawing/picture_image.h"

namespace orbweave {

/// A feature that a track of the model holds.
struct PictureFeature {
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();
  uint32_t track_length = 2;
  double residual_px = 0.0;
};

/// A direction with a name: where another panorama stands.
struct PictureDirection {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  std::string label{};
};

enum class FeatureColors { kTrackLength, kResidual };

struct ImagePicture {
  PictureImage image{};
  std::vector<std::string> headlines{};      ///< the first one as a title
  std::vector<Eigen::Vector2d> unused_px{};  ///< features in no track
  std::vector<PictureFeature> tracked{};
  FeatureColors colors = FeatureColors::kTrackLength;
  std::vector<PictureDirection> directions{};
};

/// A PNG file, kPictureWidth_px wide: features in no track as small grey dots, the others
/// coloured by the number of panoramas that see their point, or by their residual; diamonds where
/// other panoramas stand.
[[nodiscard]] absl::StatusOr<std::string> DrawImage(const ImagePicture& picture);

}  // namespace orbweave
