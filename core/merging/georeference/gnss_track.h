// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// An image of a model that has a GNSS position.
struct DrivenFix {
  ImageId image{};
  Eigen::Vector3d centre_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();
  double horizontal_sigma_m = 1.0;  ///< stated, per axis
  double vertical_sigma_m = 1.0;
  double way = 0.0;  ///< from the first of its drive, along the model, world units
  /// Where the carrier goes, in the world: per second where the drive's times are known, else of
  /// unit length; zero where it does not move, and where that is not known.
  Eigen::Vector3d travel = Eigen::Vector3d::Zero();
};

/// The fixes of one drive, one after the other (DriveSequences).
struct GnssDrive {
  uint32_t drive = 0;
  bool has_times = false;
  std::vector<DrivenFix> fixes{};
};

/// Drives that have fixes, by number. Loose images take no part. Linear in the images.
[[nodiscard]] std::vector<GnssDrive> GnssDrivesOf(const Reconstruction& reconstruction,
                                                  const ImageManifest& manifest);

}  // namespace orbweave
