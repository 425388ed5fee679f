// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/spanning_forest.h"

#include <algorithm>
#include <numeric>

#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

/// Per node, its edges in the forest.
std::vector<std::vector<uint32_t>> ForestEdges(const std::vector<GraphEdge>& edges,
                                               const Eigen::VectorXd& strength,
                                               size_t num_nodes) {
  std::vector<uint32_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](uint32_t x, uint32_t y) {
    return strength[x] > strength[y];
  });
  DisjointSets sets(static_cast<uint32_t>(num_nodes));
  std::vector<std::vector<uint32_t>> edges_of(num_nodes);
  for (const uint32_t e : order) {
    if (!sets.Unite(edges[e].a, edges[e].b)) continue;
    edges_of[edges[e].a].push_back(e);
    edges_of[edges[e].b].push_back(e);
  }
  return edges_of;
}

}  // namespace

std::vector<ForestStep> WalkSpanningForest(const std::vector<GraphEdge>& edges,
                                           const Eigen::VectorXd& strength,
                                           std::span<const uint8_t> is_root) {
  const std::vector<std::vector<uint32_t>> edges_of = ForestEdges(edges, strength, is_root.size());
  std::vector<uint8_t> is_reached(is_root.begin(), is_root.end());
  std::vector<uint32_t> queue;
  for (uint32_t node = 0; node < is_root.size(); ++node) {
    if (is_root[node] != 0) queue.push_back(node);
  }
  std::vector<ForestStep> steps;
  for (size_t next = 0; next < queue.size(); ++next) {
    const uint32_t from = queue[next];
    for (const uint32_t e : edges_of[from]) {
      const uint32_t to = edges[e].a == from ? edges[e].b : edges[e].a;
      if (is_reached[to] != 0) continue;
      is_reached[to] = 1;
      steps.push_back({e, from, to});
      queue.push_back(to);
    }
  }
  return steps;
}

}  // namespace orbweave
