// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/reconstructed_share.h"

namespace orbweave {

double ReconstructedShare(const MappingState& state, const LinkedPair& pair) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  uint32_t common = 0;
  for (const FeatureMatch& match : geometry.inliers) {
    const PointIndex point = state.PointOf(state.Graph().node_of_feature[pair.a][match.a]);
    if (point != kNoPoint &&
        point == state.PointOf(state.Graph().node_of_feature[pair.b][match.b])) {
      ++common;
    }
  }
  return static_cast<double>(common) / static_cast<double>(geometry.inliers.size());
}

}  // namespace orbweave
