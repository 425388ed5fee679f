// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/matches_in_planes.h"

#include <algorithm>

#include "core/geometry/epipolar.h"
#include "core/mapping/lengths/log_length_of_pair.h"

namespace orbweave {

void VisitMatches(
    const MappingState& state,
    const LinkedPair& pair,
    double tolerance_px,
    const std::function<void(bool, const Eigen::Vector3d&, const Eigen::Vector3d&)>& visit) {
  const CorrespondenceGraph& graph = state.Graph();
  Rigid3 b_from_a = state.CamFromWorld(pair.b) * state.CamFromWorld(pair.a).Inverse();
  b_from_a.translation.normalize();
  const PoseOfRays rays_of(b_from_a);
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node a = graph.node_of_feature[pair.a][match.a];
    const Eigen::Vector3d& p_a = graph.bearing_of_node[a];
    const Eigen::Vector3d& p_b = graph.bearing_of_node[graph.node_of_feature[pair.b][match.b]];
    const RayPair rays = rays_of(p_a, p_b);
    visit(
        rays.IsWithin(AngleFromPixels(state, a, tolerance_px)) && rays.IsInFrontOfBoth(), p_a, p_b);
  }
}

LengthAgreement AgreementOfMatches(const MappingState& state,
                                   const LinkedPair& pair,
                                   double tolerance_px) {
  LengthAgreement matches;
  if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b) ||
      state.Problem().pairs[pair.index].kind != TwoViewKind::kGeneral) {
    return matches;
  }
  VisitMatches(state, pair, tolerance_px, [&](bool agrees, const auto&, const auto&) {
    matches.told += 1.0;
    matches.agreeing += agrees ? 1.0 : 0.0;
  });
  const double weight = std::min(1.0, kMaxRaysOfPair / std::max(matches.told, 1.0));
  return {.told = weight * matches.told, .agreeing = weight * matches.agreeing};
}

double CountMatchesInPlanes(const MappingState& state, double tolerance_px) {
  double count = 0.0;
  for (const LinkedPair& pair : state.Graph().pairs)
    count += AgreementOfMatches(state, pair, tolerance_px).agreeing;
  return count;
}

}  // namespace orbweave
