// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/matches_in_planes.h"

#include <algorithm>

#include "core/mapping/lengths/log_length_of_pair.h"

namespace orbweave {
namespace {

PoseOfRays RaysAt(Rigid3 b_from_a) {
  b_from_a.translation.normalize();
  return PoseOfRays(b_from_a);
}

void VisitMatchesAt(const Rigid3& b_from_a,
                    const MappingState& state,
                    const LinkedPair& pair,
                    const std::function<void(const PosedMatch&)>& visit) {
  const CorrespondenceGraph& graph = state.Graph();
  const PoseOfRays rays_of = RaysAt(b_from_a);
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node a = graph.node_of_feature[pair.a][match.a];
    const Node b = graph.node_of_feature[pair.b][match.b];
    PosedMatch posed{.in_a = graph.bearing_of_node[a],
                     .in_b = graph.bearing_of_node[b],
                     .pixel_rad = AngleFromPixels(state, a, 1.0)};
    posed.rays = rays_of(posed.in_a, posed.in_b);
    visit(posed);
  }
}

}  // namespace

void VisitMatches(const MappingState& state,
                  const LinkedPair& pair,
                  const std::function<void(const PosedMatch&)>& visit) {
  VisitMatchesAt(PoseInModel(state, pair), state, pair, visit);
}

std::vector<PosedMatch> OwnMatches(const MappingState& state,
                                   const LinkedPair& pair,
                                   double tolerance_px) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  std::vector<PosedMatch> own;
  if (geometry.kind != TwoViewKind::kGeneral) return own;
  VisitMatchesAt(geometry.b_from_a, state, pair, [&](const PosedMatch& match) {
    if (match.IsInPlanes(tolerance_px)) own.push_back(match);
  });
  const PoseOfRays rays_of = RaysAt(PoseInModel(state, pair));
  for (PosedMatch& match : own) match.rays = rays_of(match.in_a, match.in_b);
  return own;
}

LengthAgreement AgreementOfMatches(const MappingState& state,
                                   const LinkedPair& pair,
                                   double tolerance_px) {
  LengthAgreement matches;
  if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b) ||
      state.Problem().pairs[pair.index].kind != TwoViewKind::kGeneral) {
    return matches;
  }
  VisitMatches(state, pair, [&](const PosedMatch& match) {
    matches.told += 1.0;
    matches.agreeing += match.Agrees(tolerance_px) ? 1.0 : 0.0;
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
