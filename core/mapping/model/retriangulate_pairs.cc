// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/retriangulate_pairs.h"

#include "core/mapping/model/reconstructed_share.h"

namespace orbweave {
namespace {

void RetriangulateMatch(MappingState& state, Node a, Node b, const TrackLimits& limits) {
  const bool a_is_free = state.PointOf(a) == kNoPoint;
  const bool b_is_free = state.PointOf(b) == kNoPoint;
  if (a_is_free && b_is_free) {
    CreatePoint(state, a, {&b, 1}, limits);
  } else if (a_is_free) {
    ContinueTrack(state, a, limits);
  } else if (b_is_free) {
    ContinueTrack(state, b, limits);
  }
}

}  // namespace

void RetriangulatePair(MappingState& state, const LinkedPair& pair, const TrackLimits& limits) {
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    RetriangulateMatch(state,
                       state.Graph().node_of_feature[pair.a][match.a],
                       state.Graph().node_of_feature[pair.b][match.b],
                       limits);
  }
}

uint32_t RetriangulatePairs(MappingState& state, const TrackLimits& limits) {
  const uint32_t before = state.NumObservations();
  for (const LinkedPair& pair : state.Graph().pairs) {
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b) ||
        ReconstructedShare(state, pair) >= kUnderReconstructedShare) {
      continue;
    }
    RetriangulatePair(state, pair, limits);
  }
  return state.NumObservations() - before;
}

}  // namespace orbweave
