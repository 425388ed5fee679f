// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_by_pairs.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "core/averaging/average_differences.h"
#include "core/mapping/positioning/average_baselines.h"
#include "core/mapping/positioning/pair_directions.h"
#include "core/mapping/positioning/place_in_enu.h"
#include "core/mapping/positioning/position_agreement.h"

namespace orbweave {
namespace {

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
  ORBWEAVE_ASSIGN_OR_RETURN(const PairDirections pairs,
                            FindPairDirections(problem, graph, available, options, context));
  const double min_angle_rad = options.min_angle_deg * std::numbers::pi / 180.0;
  ORBWEAVE_ASSIGN_OR_RETURN(const BaselineLengths baselines,
                            AverageBaselines(problem,
                                             graph,
                                             pairs.pairs,
                                             GnssSteps(problem, graph, pairs.pairs),
                                             min_angle_rad,
                                             context));
  DifferenceGraph displacements = Displacements(pairs, baselines.lengths);
  PairPlacement placement{.images = LargestPart(displacements.num_nodes, displacements.edges)};
  KeepEdgesAmong(placement.images, displacements);
  std::optional<EnuPlacement> placed;
  if (baselines.in_metres) {
    ORBWEAVE_ASSIGN_OR_RETURN(placed,
                              PlaceInEnu(problem,
                                         placement.images,
                                         pairs.cams_from_world,
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
        Rigid3::FromCentre(pairs.cams_from_world[image] * placed->enu_from_world.conjugate(),
                           placed->centres.row(image).transpose()));
  }
  return placement;
}

}  // namespace orbweave
