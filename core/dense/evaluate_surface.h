// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/dense/observed_surface.h"

namespace orbweave {

struct SurfaceEvaluationOptions {
  std::vector<double> tolerances_m{0.02, 0.05, 0.10, 0.20};
  double voxel_m = 0.01;  ///< edge of the cubes that weigh alike
};

/// Shares in 0 ... 1.
struct SurfaceScore {
  double tolerance_m = 0.0;
  double precision = 0.0;  ///< accuracy: of the cloud, what lies within the tolerance of the truth
  double recall = 0.0;     ///< completeness: of the truth, what the cloud comes so near to
  double f1 = 0.0;         ///< their harmonic mean; 0 when both are
};

struct SurfaceEvaluation {
  std::vector<SurfaceScore> scores{};  ///< one per tolerance, in their order
  size_t cloud_points = 0;             ///< that were judged
  size_t truth_points = 0;
  double median_error_m = 0.0;  ///< of the cloud's points nearer than the largest tolerance
};

/// Holds a cloud against samples of the true surface, both in one frame, by the protocol of ETH3D
/// (Schoeps et al.: A multi-view stereo benchmark with high-resolution images and multi-camera
/// videos, CVPR 2017): a point is right when the nearest of the other side is no farther than the
/// tolerance; the share of right ones is taken in each voxel and averaged over the voxels that hold
/// any, so that densely sampled places weigh no more than others. Of the two-sided measure what the
/// truth never saw (a cloud behind all walls) counts as wrong, unless a region is named.
///
/// `region`: of the truth only points that enough cameras of it see, of the cloud those in reach of
/// as many are judged; both against all points of the other side. Without it all are. Points that
/// are not finite are left out. Where nothing is to be judged, shares are 0 and so are the counts.
[[nodiscard]] SurfaceEvaluation EvaluateSurface(
    std::span<const Eigen::Vector3d> cloud,
    std::span<const Eigen::Vector3d> truth,
    const SurfaceEvaluationOptions& options = {},
    const std::optional<SurfaceRegion>& region = std::nullopt);

}  // namespace orbweave
