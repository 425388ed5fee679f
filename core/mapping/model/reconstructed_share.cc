// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/reconstructed_share.h"

namespace orbweave {

size_t CountReconstructed(const MappingState& state, const LinkedPair& pair) {
  const CorrespondenceGraph& graph = state.Graph();
  size_t common = 0;
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const PointIndex point = state.PointOf(graph.node_of_feature[pair.a][match.a]);
    if (point != kNoPoint && point == state.PointOf(graph.node_of_feature[pair.b][match.b]))
      ++common;
  }
  return common;
}

double ReconstructedShare(const MappingState& state, const LinkedPair& pair) {
  return static_cast<double>(CountReconstructed(state, pair)) /
         static_cast<double>(state.Problem().pairs[pair.index].inliers.size());
}

}  // namespace orbweave
