// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <algorithm>
#include <numeric>

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

std::vector<double> ImageCosts(const ViewGraph& graph) {
  std::vector<uint32_t> inliers(graph.num_images, 0);
  for (const ViewEdge& edge : graph.edges) {
    for (const ImageId image : {edge.pair.a, edge.pair.b})
      inliers[image.value] = std::max(inliers[image.value], edge.num_inliers);
  }
  const auto joined = std::ranges::count_if(inliers, [](uint32_t n) { return n > 0; });
  const double sum = std::accumulate(inliers.begin(), inliers.end(), 0.0);
  const double per_mean = sum > 0.0 ? static_cast<double>(joined) / sum : 0.0;
  std::vector<double> costs;
  costs.reserve(inliers.size());
  for (const uint32_t n : inliers) costs.push_back(0.5 * (1.0 + n * per_mean));
  return costs;
}

}  // namespace orbweave
