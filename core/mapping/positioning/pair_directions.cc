// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/pair_directions.h"

#include <numbers>
#include <utility>

#include "core/averaging/average_rotations.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

constexpr double kMaxRotationErrorRad = 2.0 * std::numbers::pi / 180.0;

/// Pairs that say how images lie to each other, as indices into graph.pairs.
std::vector<uint32_t> SelectPairs(const ClusterProblem& problem,
                                  const CorrespondenceGraph& graph,
                                  std::span<const uint8_t> available,
                                  const MappingOptions& options) {
  std::vector<uint32_t> pairs;
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    const LinkedPair& pair = graph.pairs[p];
    if (available[pair.a] != 0 && available[pair.b] != 0 &&
        problem.pairs[pair.index].inliers.size() >= static_cast<size_t>(options.min_inliers)) {
      pairs.push_back(p);
    }
  }
  return pairs;
}

/// The pairs as a view graph whose images are the cluster's slots.
ViewGraph ViewGraphOf(const ClusterProblem& problem,
                      const CorrespondenceGraph& graph,
                      std::span<const uint32_t> pairs) {
  ViewGraph view_graph{.num_images = graph.NumImages()};
  for (const uint32_t p : pairs) {
    const LinkedPair& pair = graph.pairs[p];
    const TwoViewGeometry& geometry = problem.pairs[pair.index];
    view_graph.edges.push_back({.pair = {ImageId(pair.a), ImageId(pair.b)},
                                .kind = geometry.kind,
                                .b_from_a = geometry.b_from_a,
                                .num_inliers = static_cast<uint32_t>(geometry.inliers.size()),
                                .median_angle_rad = geometry.median_angle_rad,
                                .spread = geometry.spread});
  }
  return view_graph;
}

bool HasDirection(const ViewEdge& edge) {
  return edge.kind != TwoViewKind::kPureRotation && edge.median_angle_rad > 0.0;
}

}  // namespace

absl::StatusOr<PairDirections> FindPairDirections(const ClusterProblem& problem,
                                                  const CorrespondenceGraph& graph,
                                                  std::span<const uint8_t> available,
                                                  const MappingOptions& options,
                                                  const StageContext& context) {
  const std::vector<uint32_t> pairs = SelectPairs(problem, graph, available, options);
  const ViewGraph view_graph = ViewGraphOf(problem, graph, pairs);
  ORBWEAVE_ASSIGN_OR_RETURN(AveragedRotations rotations, AverageRotations(view_graph, context));
  PairDirections found{.cams_from_world = std::move(rotations.cam_from_world)};
  for (uint32_t e = 0; e < view_graph.edges.size(); ++e) {
    if (rotations.error_rad[e] > kMaxRotationErrorRad || !HasDirection(view_graph.edges[e]))
      continue;
    found.edges.push_back(view_graph.edges[e]);
    found.pairs.push_back(pairs[e]);
  }
  return found;
}

DifferenceGraph Displacements(const PairDirections& pairs, std::span<const double> lengths) {
  DifferenceGraph graph{.num_nodes = static_cast<uint32_t>(pairs.cams_from_world.size())};
  const auto num_edges = static_cast<Eigen::Index>(pairs.edges.size());
  graph.differences.resize(num_edges, 3);
  graph.weights.resize(num_edges);
  Eigen::Index row = 0;
  for (size_t e = 0; e < pairs.edges.size(); ++e) {
    if (lengths[e] == 0.0) continue;
    const ViewEdge& edge = pairs.edges[e];
    graph.edges.push_back({edge.pair.a.value, edge.pair.b.value});
    graph.differences.row(row) = lengths[e] * pairs.Direction(e).transpose();
    const double angle_per_length = edge.median_angle_rad / lengths[e];
    graph.weights[row] = edge.num_inliers * angle_per_length * angle_per_length;
    ++row;
  }
  graph.differences.conservativeResize(row, 3);
  graph.weights.conservativeResize(row);
  return graph;
}

std::vector<ImageSlot> LargestPart(uint32_t num_images, std::span<const GraphEdge> edges) {
  if (edges.empty()) return {};
  DisjointSets sets(num_images);
  for (const GraphEdge& edge : edges) sets.Unite(edge.a, edge.b);
  uint32_t largest = 0;
  for (uint32_t image = 0; image < num_images; ++image) {
    if (sets.SizeOf(image) > sets.SizeOf(largest)) largest = image;
  }
  std::vector<ImageSlot> images;
  for (uint32_t image = 0; image < num_images; ++image) {
    if (sets.Find(image) == sets.Find(largest)) images.push_back(image);
  }
  return images;
}

}  // namespace orbweave
