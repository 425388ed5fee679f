// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_contradicted_pairs.h"

namespace orbweave {

std::vector<ImagePair> FindContradictedPairs(const MappingState& state,
                                             const MappingOptions& options) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<ImagePair> contradicted;
  for (const LinkedPair& pair : graph.pairs) {
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) continue;
    const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
    int same = 0;
    int both = 0;
    for (const FeatureMatch& match : geometry.inliers) {
      const PointIndex point_a = state.PointOf(graph.node_of_feature[pair.a][match.a]);
      const PointIndex point_b = state.PointOf(graph.node_of_feature[pair.b][match.b]);
      if (point_a == kNoPoint || point_b == kNoPoint) continue;
      ++both;
      if (point_a == point_b) ++same;
    }
    if (both >= options.min_inliers && 2 * same < both) contradicted.push_back(geometry.pair);
  }
  return contradicted;
}

}  // namespace orbweave
