// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/merge_points.h"

#include <algorithm>
#include <optional>

#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

bool Explains(const MappingState& state,
              const Eigen::Vector3d& position,
              const std::vector<Node>& nodes,
              double max_error_px) {
  return std::ranges::all_of(
      nodes, [&](Node node) { return IsExplained(state, position, node, max_error_px); });
}

std::optional<Eigen::Vector3d> TriangulateAll(const MappingState& state,
                                              const std::vector<Node>& nodes) {
  std::vector<Rigid3> cams_from_world;
  std::vector<Eigen::Vector3d> bearings;
  for (const Node node : nodes) {
    cams_from_world.push_back(state.CamFromWorld(state.Graph().image_of_node[node]));
    bearings.push_back(state.Graph().bearing_of_node[node]);
  }
  return TriangulateRays(cams_from_world, bearings);
}

/// A position that explains the nodes of both points.
std::optional<Eigen::Vector3d> CommonPosition(const MappingState& state,
                                              const MappedPoint& a,
                                              const MappedPoint& b,
                                              double max_error_px) {
  const auto weight_a = static_cast<double>(a.nodes.size());
  const auto weight_b = static_cast<double>(b.nodes.size());
  const Eigen::Vector3d mean =
      (weight_a * a.position + weight_b * b.position) / (weight_a + weight_b);
  if (Explains(state, mean, a.nodes, max_error_px) &&
      Explains(state, mean, b.nodes, max_error_px)) {
    return mean;
  }
  // Joint triangulation costs more; only where each position is near the other's rays.
  if (!Explains(state, a.position, b.nodes, 4.0 * max_error_px)) return std::nullopt;
  std::vector<Node> nodes = a.nodes;
  nodes.insert(nodes.end(), b.nodes.begin(), b.nodes.end());
  const std::optional<Eigen::Vector3d> position = TriangulateAll(state, nodes);
  if (!position || !Explains(state, *position, nodes, max_error_px)) return std::nullopt;
  return position;
}

/// The nodes of both points, of each image the one with the smallest error.
std::vector<Node> UnitedNodes(const MappingState& state,
                              const Eigen::Vector3d& position,
                              const MappedPoint& a,
                              const MappedPoint& b) {
  struct Ranked {
    ImageSlot image;
    double error;
    Node node;
    auto operator<=>(const Ranked&) const = default;
  };
  std::vector<Ranked> ranked;
  for (const MappedPoint* point : {&a, &b}) {
    for (const Node node : point->nodes) {
      ranked.push_back({state.Graph().image_of_node[node], NodeError(state, position, node), node});
    }
  }
  std::ranges::sort(ranked, [](const Ranked& x, const Ranked& y) { return (x <=> y) < 0; });
  std::vector<Node> nodes;
  for (size_t i = 0; i < ranked.size(); ++i) {
    if (i == 0 || ranked[i].image != ranked[i - 1].image) nodes.push_back(ranked[i].node);
  }
  return nodes;
}

/// The point that `point` and one of its matched points became; kNoPoint: none fits.
PointIndex MergeOnce(MappingState& state, PointIndex point, double max_error_px) {
  std::vector<PointIndex> tried;
  for (const Node node : state.Point(point).nodes) {
    for (const Node other : state.Graph().Neighbours(node)) {
      const PointIndex candidate = state.PointOf(other);
      if (candidate == kNoPoint || candidate == point || std::ranges::count(tried, candidate) > 0) {
        continue;
      }
      tried.push_back(candidate);
      const PointIndex merged = MergePair(state, point, candidate, max_error_px);
      if (merged != kNoPoint) return merged;
    }
  }
  return kNoPoint;
}

}  // namespace

PointIndex MergePair(MappingState& state, PointIndex a, PointIndex b, double max_error_px) {
  const auto position = CommonPosition(state, state.Point(a), state.Point(b), max_error_px);
  if (!position) return kNoPoint;
  const std::vector<Node> nodes = UnitedNodes(state, *position, state.Point(a), state.Point(b));
  state.RemovePoint(a);
  state.RemovePoint(b);
  return state.AddPoint(*position, nodes);
}

uint32_t MergePoints(MappingState& state, std::span<const PointIndex> points, double max_error_px) {
  uint32_t merged = 0;
  for (PointIndex point : points) {
    while (point != kNoPoint && state.Exists(point)) {
      point = MergeOnce(state, point, max_error_px);
      if (point != kNoPoint) ++merged;
    }
  }
  return merged;
}

}  // namespace orbweave
