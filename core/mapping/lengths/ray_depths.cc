// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/ray_depths.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace orbweave {
namespace {

/// Towards the baseline itself depths are as good as unknown.
constexpr double kMinSine = 0.05;

/// In linear time; `depths`: by pair.
std::vector<RayDepth> SortedByNode(std::span<const RayDepth> depths, uint32_t num_nodes) {
  std::vector<uint32_t> next(num_nodes + 1, 0);
  for (const RayDepth& depth : depths) ++next[depth.node + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  std::vector<RayDepth> sorted(depths.size());
  for (const RayDepth& depth : depths) sorted[next[depth.node]++] = depth;
  return sorted;
}

}  // namespace

std::vector<RayDepth> MeasureRayDepths(const ClusterProblem& problem,
                                       const CorrespondenceGraph& graph,
                                       std::span<const uint32_t> pairs,
                                       double min_angle_rad) {
  const double min_sin_angle = std::sin(min_angle_rad);
  std::vector<RayDepth> depths;
  for (uint32_t i = 0; i < pairs.size(); ++i) {
    const LinkedPair& pair = graph.pairs[pairs[i]];
    const TwoViewGeometry& geometry = problem.pairs[pair.index];
    const Eigen::Matrix3d a_from_b = geometry.b_from_a.rotation.conjugate().toRotationMatrix();
    const Eigen::Vector3d baseline = geometry.b_from_a.Centre();
    for (const FeatureMatch& match : geometry.inliers) {
      const Node a = graph.node_of_feature[pair.a][match.a];
      const Node b = graph.node_of_feature[pair.b][match.b];
      const Eigen::Vector3d ray_a = graph.bearing_of_node[a];
      const Eigen::Vector3d ray_b = a_from_b * graph.bearing_of_node[b];
      const double sin_x = ray_a.cross(ray_b).norm();
      const double sin_a = baseline.cross(ray_a).norm();
      const double sin_b = baseline.cross(ray_b).norm();
      if (sin_x < min_sin_angle || sin_a < kMinSine || sin_b < kMinSine) continue;
      depths.push_back({a, i, std::log(sin_b / sin_x)});
      depths.push_back({b, i, std::log(sin_a / sin_x)});
    }
  }
  return SortedByNode(depths, graph.NumNodes());
}

std::optional<double> MedianReach(std::span<double> log_reaches) {
  if (log_reaches.empty()) return std::nullopt;
  const auto middle =
      log_reaches.begin() + static_cast<std::ptrdiff_t>((log_reaches.size() - 1) / 2);
  std::ranges::nth_element(log_reaches, middle);
  return *middle;
}

LengthsOnRay::LengthsOnRay(std::span<const RayDepth> ray, std::span<const double> log_lengths) {
  reaches_.reserve(ray.size());
  for (const RayDepth& depth : ray)
    reaches_.push_back({log_lengths[depth.pair] + depth.log_depth, depth.pair});
  std::ranges::sort(reaches_, {}, &Reach::log_distance);
}

std::optional<double> LengthsOnRay::ToldByOthers(const RayDepth& asked) const {
  const auto of_others = [&](const Reach& reach) { return reach.pair != asked.pair; };
  const auto count = std::ranges::count_if(reaches_, of_others);
  if (count == 0) return std::nullopt;
  auto median = std::ranges::find_if(reaches_, of_others);
  for (auto before = (count - 1) / 2; before > 0; --before)
    median = std::find_if(median + 1, reaches_.end(), of_others);
  return median->log_distance - asked.log_depth;
}

}  // namespace orbweave
