// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/dense/panorama_raster.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// A point whose range is known, as of a track.
struct DepthSeed {
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();  ///< unit, camera frame
  double range_m = 0.0;
  double sigma_m = 0.0;
};

/// Another panorama that sees what the reference sees; of the same size.
struct DepthSource {
  PanoramaRaster image{};
  Rigid3 source_from_reference{};
};

/// Whose depths are asked for, and by what. The same content gives the same bytes.
struct DepthProblem {
  PanoramaRaster reference{};
  std::vector<DepthSource> sources{};  ///< at most kMaxDepthSources are used, in this order
  std::vector<DepthSeed> seeds{};      ///< may be empty
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  uint64_t seed = 0;  ///< of random numbers; derived from content
};

inline constexpr int kMaxDepthSources = 8;

}  // namespace orbweave
