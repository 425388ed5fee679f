// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <algorithm>

namespace orbweave {
namespace {

constexpr double kMinSpread = 1.0 / 64.0;

}  // namespace

std::vector<double> EdgeWeights(const ViewGraph& graph) {
  std::vector<double> weights;
  weights.reserve(graph.edges.size());
  for (const ViewEdge& edge : graph.edges) {
    weights.push_back(std::max(1U, edge.num_inliers) * std::max(edge.spread, kMinSpread));
  }
  return weights;
}

}  // namespace orbweave
