// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/turn_forest.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

constexpr size_t kMostImages = 64;

/// Heaviest first.
std::vector<uint32_t> ByWeight(const std::vector<MotionEdge>& edges) {
  std::vector<uint32_t> order(edges.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(
      order, [&](uint32_t x, uint32_t y) { return edges[x].weight > edges[y].weight; });
  return order;
}

}  // namespace

TurnForest::TurnForest(uint32_t num_images, const std::vector<MotionEdge>& edges)
    : links_(num_images) {
  DisjointSets sets(num_images);
  for (const uint32_t e : ByWeight(edges)) {
    const MotionEdge& edge = edges[e];
    if (!sets.Unite(edge.a, edge.b)) continue;
    links_[edge.a].push_back({edge.b, edge.turn_rad});
    links_[edge.b].push_back({edge.a, -edge.turn_rad});
  }
}

std::vector<TurnForest::Link> TurnForest::Around(uint32_t image, size_t reach) const {
  struct Visit {
    uint32_t from = 0;
    size_t edges = 0;
  };
  std::vector<Link> around = {{image, 0.0}};
  std::vector<Visit> visits = {{image, 0}};
  for (size_t i = 0; i < around.size(); ++i) {
    if (visits[i].edges == reach) break;
    const Link here = around[i];
    for (const Link& next : links_[here.image]) {
      if (next.image == visits[i].from) continue;
      if (around.size() == kMostImages) return around;
      around.push_back({next.image, here.turn_rad + next.turn_rad});
      visits.push_back({here.image, visits[i].edges + 1});
    }
  }
  return around;
}

}  // namespace orbweave
