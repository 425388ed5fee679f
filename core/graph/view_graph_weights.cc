// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <algorithm>

namespace orbweave {
namespace {

constexpr double kMinSpread = 1.0 / 64.0;
constexpr double kMaxCost = 4.0;

}  // namespace

std::vector<double> EdgeWeights(const ViewGraph& graph) {
  std::vector<double> weights;
  weights.reserve(graph.edges.size());
  for (const ViewEdge& edge : graph.edges) {
    weights.push_back(std::max(1U, edge.num_inliers) * std::max(edge.spread, kMinSpread));
  }
  return weights;
}

std::vector<double> ImageCosts(const ViewGraph& graph) {
  std::vector<double> costs(graph.num_images, 0.0);
  double total = 0.0;
  for (const ViewEdge& edge : graph.edges) {
    const double matches = std::max(1U, edge.num_inliers);
    costs[edge.pair.a.value] += matches;
    costs[edge.pair.b.value] += matches;
    total += 2.0 * matches;
  }
  const auto num_joined =
      std::count_if(costs.begin(), costs.end(), [](double c) { return c > 0.0; });
  const double mean = total / static_cast<double>(std::max<std::ptrdiff_t>(1, num_joined));
  for (double& cost : costs) {
    if (cost > 0.0) cost = std::clamp(cost / mean, 1.0 / kMaxCost, kMaxCost);
  }
  return costs;
}

}  // namespace orbweave
