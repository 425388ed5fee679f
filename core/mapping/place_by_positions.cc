// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/place_by_positions.h"

#include <algorithm>
#include <vector>

#include "core/mapping/pair_directions.h"
#include "core/mapping/position_agreement.h"
#include "core/mapping/position_system.h"
#include "core/mapping/turn_to_enu.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kMinAgreeing = 0.7;

/// The largest set of images that directions join, ascending.
std::vector<ImageSlot> JoinedImages(const PairDirections& pairs) {
  std::vector<GraphEdge> edges;
  for (const ViewEdge& edge : pairs.edges) edges.push_back({edge.pair.a.value, edge.pair.b.value});
  return LargestPart(static_cast<uint32_t>(pairs.cams_from_world.size()), edges);
}

/// Directions as displacements that are as long as positions have them.
DifferenceGraph DirectionsAsLongAsPositions(const ClusterProblem& problem,
                                            const PairDirections& pairs) {
  DifferenceGraph steps{.num_nodes = static_cast<uint32_t>(pairs.cams_from_world.size())};
  const auto num_edges = static_cast<Eigen::Index>(pairs.edges.size());
  steps.differences.resize(num_edges, 3);
  steps.weights = Eigen::VectorXd::Ones(num_edges);
  Eigen::Index row = 0;
  for (size_t e = 0; e < pairs.edges.size(); ++e) {
    const uint32_t a = pairs.edges[e].pair.a.value;
    const uint32_t b = pairs.edges[e].pair.b.value;
    const PosePrior& of_a = problem.images[a].prior;
    const PosePrior& of_b = problem.images[b].prior;
    if (!of_a.position_in_enu || !of_b.position_in_enu) continue;
    const double length_m = (*of_b.position_in_enu - *of_a.position_in_enu).head<2>().norm();
    steps.edges.push_back({a, b});
    steps.differences.row(row++) = length_m * pairs.Direction(e).transpose();
  }
  steps.differences.conservativeResize(row, 3);
  steps.weights.conservativeResize(row);
  return steps;
}

double ScatterAbout(const ClusterProblem& problem,
                    std::span<const ImageSlot> images,
                    const PositionSystem& system) {
  std::vector<double> errors;
  for (const ImageSlot image : images) {
    const PosePrior& prior = problem.images[image].prior;
    if (!prior.position_in_enu) continue;
    const Vector3d error = system.Centre(image) - *prior.position_in_enu;
    errors.push_back(error.head<2>().norm() / prior.horizontal_sigma_m);
  }
  return ScatterOfPositions(errors);
}

}  // namespace

absl::StatusOr<PairPlacement> PlaceByPositions(const ClusterProblem& problem,
                                               const CorrespondenceGraph& graph,
                                               std::span<const uint8_t> available,
                                               const MappingOptions& options,
                                               const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PairDirections pairs,
                            FindPairDirections(problem, graph, available, options, context));
  PairPlacement placement{.images = JoinedImages(pairs)};
  const std::vector<ImageSlot>& images = placement.images;
  if (!DoPositionsSpread(problem, images, 1.0)) return PairPlacement{};
  const Eigen::Quaterniond enu_from_world = EnuFromDisplacements(
      problem, images, pairs.cams_from_world, DirectionsAsLongAsPositions(problem, pairs));
  PositionSystem system(problem, images, SightsOf(problem, pairs, enu_from_world));
  if (!system.Solve(kLeastScatter)) return PairPlacement{};
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const double scatter = std::max(kLeastScatter, ScatterAbout(problem, images, system));
  if (!DoPositionsSpread(problem, images, scatter) || !system.Solve(scatter))
    return PairPlacement{};
  const auto centre_of = [&](ImageSlot image) { return system.Centre(image); };
  if (ShareOnPositions(problem, images, scatter, centre_of) < kMinAgreeing) return PairPlacement{};
  placement.position_factor = scatter;
  for (const ClusterImage& image : problem.images)
    placement.height_offset_m.push_back(system.HeightOffset(image.drive));
  for (const ImageSlot image : images) {
    placement.cams_from_world.push_back(Rigid3::FromCentre(
        pairs.cams_from_world[image] * enu_from_world.conjugate(), system.Centre(image)));
  }
  return placement;
}

}  // namespace orbweave
