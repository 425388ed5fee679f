// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

struct DatabaseImage {
  std::string name{};
  uint32_t database_id = 0;  ///< image_id in the file
  EquirectangularCamera camera{};
  std::vector<Keypoint> keypoints{};
  /// pose_priors: WGS84 in `geodetic`, Cartesian in `position_in_enu`; sigmas from the covariance
  /// when given. An altitude that cannot be is NaN.
  PosePrior prior{};
  bool prior_sigma_known = false;
};

/// Keypoints and matches from a COLMAP database, in our own ids.
struct ColmapDatabase {
  /// Natural name order: images[i] is ImageId i, whatever its id in the file.
  std::vector<DatabaseImage> images{};
  /// Sorted by pair. From two_view_geometries: `inliers`, kind and b_from_a where the file has them
  /// (kNone: it has matches but no pose). When that table is empty, the raw matches stand in
  /// `inliers`.
  std::vector<TwoViewGeometry> pairs{};
  bool matches_are_verified = true;     ///< false: `inliers` are raw matches
  std::vector<std::string> warnings{};  ///< what is left out
};

}  // namespace orbweave
