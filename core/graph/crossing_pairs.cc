// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/crossing_pairs.h"

#include <algorithm>

#include "core/graph/shared_images.h"

namespace orbweave {

std::vector<CrossingPair> CrossingPairs(const ViewGraph& graph, const Partition& partition) {
  const auto clusters_of_image = ClustersOfImages(partition.clusters, graph.num_images);
  std::vector<CrossingPair> crossing;
  for (const ViewEdge& edge : graph.edges) {
    const auto& of_a = clusters_of_image[edge.pair.a.value];
    const auto& of_b = clusters_of_image[edge.pair.b.value];
    const bool is_within =
        std::ranges::find_first_of(of_a, of_b) != of_a.end() || edge.kind != TwoViewKind::kGeneral;
    if (!is_within) crossing.push_back({edge.pair, edge.b_from_a});
  }
  return crossing;
}

}  // namespace orbweave
