// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/positioning/place_by_positions.h"

#include <algorithm>
#include <vector>

#include "core/mapping/positioning/pair_directions.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/mapping/positioning/position_system.h"
#include "core/mapping/positioning/turn_to_enu.h"

namespace orbweave {
namespace {

constexpr double kMinAgreeing = 0.7;

/// The largest set of images that directions join, ascending.
std::vector<ImageSlot> JoinedImages(const PairDirections& pairs) {
  std::vector<GraphEdge> edges;
  for (const ViewEdge& edge : pairs.edges) edges.push_back({edge.pair.a.value, edge.pair.b.value});
  return LargestPart(static_cast<uint32_t>(pairs.cams_from_world.size()), edges);
}

/// Of each edge, as positions have it; 0 where one is missing.
std::vector<double> LengthsBetweenPositions(const ClusterProblem& problem,
                                            const PairDirections& pairs) {
  std::vector<double> lengths_m;
  for (const ViewEdge& edge : pairs.edges) {
    const PosePrior& a = problem.images[edge.pair.a.value].prior;
    const PosePrior& b = problem.images[edge.pair.b.value].prior;
    const bool is_known = a.position_in_enu && b.position_in_enu;
    lengths_m.push_back(is_known ? (*b.position_in_enu - *a.position_in_enu).head<2>().norm()
                                 : 0.0);
  }
  return lengths_m;
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
  const Eigen::Quaterniond enu_from_world =
      EnuFromDisplacements(problem,
                           images,
                           pairs.cams_from_world,
                           Displacements(pairs, LengthsBetweenPositions(problem, pairs)));
  PositionSystem system(problem, images, SightsOf(problem, pairs, enu_from_world));
  if (!system.Solve(kLeastScatter)) return PairPlacement{};
  ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
  const auto centre_of = [&](ImageSlot image) { return system.Centre(image); };
  const double scatter = std::max(kLeastScatter, ScatterAbout(problem, images, centre_of));
  if (!DoPositionsSpread(problem, images, scatter) || !system.Solve(scatter))
    return PairPlacement{};
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
