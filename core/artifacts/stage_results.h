// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/mapping/cluster_reconstruction.h"
#include "core/scene/view_graph.h"

/// What stages hand on that is more than one algorithm's return value.

namespace orbweave {

/// A partition with what the view graph lost and kept, for the report.
struct DividedViewGraph {
  Partition partition{};
  std::vector<DroppedEdge> dropped{};
  std::vector<ImagePair> edges{};
  std::vector<uint8_t> edge_kinds{};     ///< TwoViewKind of each
  std::vector<uint8_t> edge_rungs{};     ///< MatchRung of each
  std::vector<CrossingPair> crossing{};  ///< those of them that no cluster has (CrossingPairs)
};

/// The result of one cluster, with its number.
struct ClusterResult {
  uint32_t cluster = 0;
  ClusterReconstruction reconstruction{};
};

}  // namespace orbweave
