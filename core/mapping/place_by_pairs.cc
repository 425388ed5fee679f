// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/place_by_pairs.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/averaging/average_differences.h"
#include "core/averaging/average_rotations.h"
#include "core/graph/disjoint_sets.h"
#include "core/mapping/average_baselines.h"
#include "core/mapping/place_in_enu.h"
#include "core/mapping/position_agreement.h"

namespace orbweave {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
/// Pairs whose rotation is off by more are wrong.
constexpr double kMaxRotationErrorRad = 2.0 * kRadiansPerDegree;

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

/// Displacements C_b - C_a in the world as a graph over images.
DifferenceGraph DisplacementGraph(const ViewGraph& view_graph,
                                  const std::vector<uint32_t>& edges,
                                  const std::vector<double>& lengths,
                                  const std::vector<Eigen::Quaterniond>& cam_from_world) {
  DifferenceGraph graph{.num_nodes = view_graph.num_images};
  const auto num_edges = static_cast<Eigen::Index>(edges.size());
  graph.differences.resize(num_edges, 3);
  graph.weights.resize(num_edges);
  Eigen::Index row = 0;
  for (size_t i = 0; i < edges.size(); ++i) {
    if (lengths[i] == 0.0) continue;
    const ViewEdge& edge = view_graph.edges[edges[i]];
    const Eigen::Vector3d displacement =
        lengths[i] * (cam_from_world[edge.pair.a.value].conjugate() * edge.b_from_a.Centre());
    graph.edges.push_back({edge.pair.a.value, edge.pair.b.value});
    graph.differences.row(row) = displacement.transpose();
    const double angle_per_length = edge.median_angle_rad / lengths[i];
    graph.weights[row] = edge.num_inliers * angle_per_length * angle_per_length;
    ++row;
  }
  graph.differences.conservativeResize(row, 3);
  graph.weights.conservativeResize(row);
  return graph;
}

/// Drops what joins other images.
void KeepEdgesAmong(const std::vector<ImageSlot>& images, DifferenceGraph& graph) {
  Eigen::Index row = 0;
  std::vector<GraphEdge> kept;
  for (size_t e = 0; e < graph.edges.size(); ++e) {
    if (!std::ranges::binary_search(images, graph.edges[e].a)) continue;
    const auto from = static_cast<Eigen::Index>(e);
    graph.differences.row(row) = graph.differences.row(from).eval();
    graph.weights[row++] = graph.weights[from];
    kept.push_back(graph.edges[e]);
  }
  graph.edges = std::move(kept);
  graph.differences.conservativeResize(row, graph.differences.cols());
  graph.weights.conservativeResize(row);
}

/// The largest set of images that edges join, ascending; empty without edges.
std::vector<ImageSlot> LargestPart(const DifferenceGraph& graph) {
  if (graph.edges.empty()) return {};
  DisjointSets sets(graph.num_nodes);
  for (const GraphEdge& edge : graph.edges) sets.Unite(edge.a, edge.b);
  uint32_t largest = 0;
  for (uint32_t image = 0; image < graph.num_nodes; ++image) {
    if (sets.SizeOf(image) > sets.SizeOf(largest)) largest = image;
  }
  std::vector<ImageSlot> images;
  for (uint32_t image = 0; image < graph.num_nodes; ++image) {
    if (sets.Find(image) == sets.Find(largest)) images.push_back(image);
  }
  return images;
}

/// Neighbours stand as images see them: what single positions are off must not move them against
/// each other. So positions that are no better between neighbours than they state count for a
/// third.
double LeastScatter(double step_factor) {
  constexpr double kHeld = 3.0;
  return std::clamp(kHeld * step_factor, 1.0, kMaxScatter);
}

}  // namespace

absl::StatusOr<PairPlacement> PlaceByPairs(const ClusterProblem& problem,
                                           const CorrespondenceGraph& graph,
                                           std::span<const uint8_t> available,
                                           const MappingOptions& options,
                                           const StageContext& context) {
  const double min_angle_rad = options.min_angle_deg * kRadiansPerDegree;
  const std::vector<uint32_t> pairs = SelectPairs(problem, graph, available, options);
  const ViewGraph view_graph = ViewGraphOf(problem, graph, pairs);
  ORBWEAVE_ASSIGN_OR_RETURN(const AveragedRotations rotations,
                            AverageRotations(view_graph, context));

  std::vector<uint32_t> edges;
  std::vector<uint32_t> pairs_of_edges;
  for (uint32_t e = 0; e < view_graph.edges.size(); ++e) {
    if (rotations.error_rad[e] > kMaxRotationErrorRad || !HasDirection(view_graph.edges[e])) {
      continue;
    }
    edges.push_back(e);
    pairs_of_edges.push_back(pairs[e]);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const BaselineLengths baselines,
                            AverageBaselines(problem,
                                             graph,
                                             pairs_of_edges,
                                             GnssSteps(problem, graph, pairs_of_edges),
                                             min_angle_rad,
                                             context));
  DifferenceGraph displacements =
      DisplacementGraph(view_graph, edges, baselines.lengths, rotations.cam_from_world);
  PairPlacement placement{.images = LargestPart(displacements)};
  KeepEdgesAmong(placement.images, displacements);
  std::optional<EnuPlacement> placed;
  if (baselines.in_metres) {
    ORBWEAVE_ASSIGN_OR_RETURN(placed,
                              PlaceInEnu(problem,
                                         placement.images,
                                         rotations.cam_from_world,
                                         displacements,
                                         LeastScatter(baselines.step_factor),
                                         context));
  }
  if (placed) {
    placement.position_factor =
        placed->scatter > 1.0 ? placed->scatter : std::min(1.0, baselines.step_factor);
    placement.height_offset_m = placed->height_offset_m;
  } else {
    ORBWEAVE_ASSIGN_OR_RETURN(AveragedDifferences averaged,
                              AverageDifferences(displacements, context));
    placed = EnuPlacement{.centres = std::move(averaged.values)};
  }
  for (const ImageSlot image : placement.images) {
    placement.cams_from_world.push_back(
        Rigid3::FromCentre(rotations.cam_from_world[image] * placed->enu_from_world.conjugate(),
                           placed->centres.row(image).transpose()));
  }
  return placement;
}

}  // namespace orbweave
