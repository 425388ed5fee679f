// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/drawing/picture_image.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// A match between pixels of two panoramas.
struct PictureMatch {
  Eigen::Vector2d a_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d b_px = Eigen::Vector2d::Zero();
  double angle_rad = 0.0;  ///< at the point; of inliers
};

struct PairPicture {
  PictureImage a{};
  PictureImage b{};
  std::vector<std::string> headlines{};  ///< the first one as a title
  std::vector<PictureMatch> outliers{};  ///< putative matches that the geometry does not explain
  std::vector<PictureMatch> inliers{};
  std::optional<Eigen::Quaterniond> b_from_a{};  ///< rotation; absent: no geometry
  /// Of b's centre seen from a, in a's frame, unit; absent: the two share a centre.
  std::optional<Eigen::Vector3d> baseline_in_a{};
  bool is_verified = true;  ///< else the geometry is the best there is, and was not accepted
};

/// A PNG file: a above b, kPictureWidth_px wide. Outliers as thin grey lines, inliers coloured
/// by the angle under which their point is seen, those of a geometry that was not accepted in one
/// colour. Of a few inliers far apart, in each panorama: the feature, and the curve on which the
/// other panorama's ray puts it, drawn boldly from the epipole (where the point would touch the
/// other camera) to the ray's vanishing point. Epipoles: where the other camera stands, and
/// opposite.
[[nodiscard]] absl::StatusOr<std::string> DrawPair(const PairPicture& picture);

}  // namespace orbweave
