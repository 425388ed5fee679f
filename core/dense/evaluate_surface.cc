// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/evaluate_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/base/status.h"
#include "core/dense/nearest_points.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// A point's voxel, and how far the other side is.
struct Judged {
  std::array<int64_t, 3> voxel{};
  double distance_m = 0.0;
};

std::array<int64_t, 3> VoxelOf(const Vector3d& point, double voxel_m) {
  std::array<int64_t, 3> voxel{};
  for (int axis = 0; axis < 3; ++axis) {
    constexpr double kFarthest = 1e18;
    voxel[static_cast<size_t>(axis)] =
        static_cast<int64_t>(std::clamp(std::floor(point[axis] / voxel_m), -kFarthest, kFarthest));
  }
  return voxel;
}

/// Sorted by voxel.
std::vector<Judged> Judge(std::span<const Vector3d> points,
                          const std::vector<uint8_t>& observers,
                          int min_observers,
                          const NearestPoints& others,
                          double voxel_m) {
  std::vector<Judged> judged;
  for (size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || observers[i] < min_observers) continue;
    judged.push_back({VoxelOf(points[i], voxel_m), others.DistanceTo(points[i])});
  }
  std::ranges::sort(judged, {}, &Judged::voxel);
  return judged;
}

/// Mean over voxels of the share within the tolerance.
double VoxelMean(const std::vector<Judged>& judged, double tolerance_m) {
  double sum = 0.0;
  size_t voxels = 0;
  for (size_t begin = 0; begin < judged.size(); ++voxels) {
    size_t end = begin;
    size_t right = 0;
    for (; end < judged.size() && judged[end].voxel == judged[begin].voxel; ++end) {
      right += judged[end].distance_m <= tolerance_m ? 1 : 0;
    }
    sum += static_cast<double>(right) / static_cast<double>(end - begin);
    begin = end;
  }
  return voxels == 0 ? 0.0 : sum / static_cast<double>(voxels);
}

double MedianOfFound(const std::vector<Judged>& judged) {
  std::vector<double> found;
  for (const Judged& point : judged) {
    if (std::isfinite(point.distance_m)) found.push_back(point.distance_m);
  }
  if (found.empty()) return 0.0;
  const auto middle = found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2);
  std::ranges::nth_element(found, middle);
  return *middle;
}

}  // namespace

SurfaceEvaluation EvaluateSurface(std::span<const Vector3d> cloud,
                                  std::span<const Vector3d> truth,
                                  const SurfaceEvaluationOptions& options,
                                  const std::optional<SurfaceRegion>& region) {
  ORBWEAVE_CHECK(!options.tolerances_m.empty() && options.voxel_m > 0.0);
  const double farthest_m = 1.001 * *std::ranges::max_element(options.tolerances_m);
  std::vector<uint8_t> of_cloud(cloud.size(), 1);
  std::vector<uint8_t> of_truth(truth.size(), 1);
  if (region) {
    of_cloud = CountInReach(cloud, *region);
    of_truth = CountObservers(truth, *region);
  }
  const int least = region ? region->min_views : 1;
  const auto judged_cloud =
      Judge(cloud, of_cloud, least, NearestPoints(truth, farthest_m), options.voxel_m);
  const auto judged_truth =
      Judge(truth, of_truth, least, NearestPoints(cloud, farthest_m), options.voxel_m);

  SurfaceEvaluation evaluation;
  evaluation.cloud_points = judged_cloud.size();
  evaluation.truth_points = judged_truth.size();
  evaluation.median_error_m = MedianOfFound(judged_cloud);
  for (const double tolerance_m : options.tolerances_m) {
    const double precision = VoxelMean(judged_cloud, tolerance_m);
    const double recall = VoxelMean(judged_truth, tolerance_m);
    const double sum = precision + recall;
    evaluation.scores.push_back(
        {tolerance_m, precision, recall, sum > 0.0 ? 2.0 * precision * recall / sum : 0.0});
  }
  return evaluation;
}

}  // namespace orbweave
