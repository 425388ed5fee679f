// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/features.h"
#include "core/scene/ids.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// One panorama as the mapper sees it: rays.
struct ClusterImage {
  ImageId id{};
  EquirectangularCamera camera{};
  std::vector<Eigen::Vector3d> bearings{};  ///< per feature, unit
  std::vector<float> sigma_rad{};           ///< per feature
  std::vector<Rgb> colors{};                ///< per feature
  PosePrior prior{};
  bool is_position_of_drive = false;  ///< PositionFix::is_of_drive
  uint32_t drive = 0;
  /// Among those of the cluster, as they were taken; captures that nobody or another cluster has
  /// count, too, up to where none sees what the others do.
  uint32_t rank_in_drive = 0;
};

/// Everything one cluster needs, and nothing else: its size does not depend on the job's.
struct ClusterProblem {
  std::vector<ClusterImage> images{};    ///< sorted by id
  std::vector<TwoViewGeometry> pairs{};  ///< among `images`, sorted by pair
};

}  // namespace orbweave
