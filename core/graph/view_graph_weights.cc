// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/view_graph_weights.h"

#include <algorithm>
#include <cstddef>
#include <functional>

#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

constexpr double kMinSpread = 1.0 / 64.0;
constexpr double kLeastCost = 0.5;
constexpr double kGreatestCost = 2.0;

double MedianOfPositive(std::vector<double> values) {
  std::erase_if(values, [](double value) { return value <= 0.0; });
  if (values.empty()) return 1.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

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
  std::vector<double> matches(graph.num_images, 0.0);
  for (const ViewEdge& edge : graph.edges) {
    matches[edge.pair.a.value] += edge.num_inliers;
    matches[edge.pair.b.value] += edge.num_inliers;
  }
  const double median = MedianOfPositive(matches);
  for (double& value : matches) {
    value = value > 0.0 ? std::clamp(value / median, kLeastCost, kGreatestCost) : 1.0;
  }
  return matches;
}

std::vector<uint32_t> StandingGroups(const ViewGraph& graph, std::span<const uint32_t> max_images) {
  std::vector<const ViewEdge*> standing;
  for (const ViewEdge& edge : graph.edges) {
    if (edge.kind == TwoViewKind::kPureRotation) standing.push_back(&edge);
  }
  std::ranges::stable_sort(standing, std::greater{}, &ViewEdge::num_inliers);
  DisjointSets sets(graph.num_images);
  for (const ViewEdge* edge : standing) {
    const uint32_t a = edge->pair.a.value;
    const uint32_t b = edge->pair.b.value;
    if (sets.SizeOf(a) + sets.SizeOf(b) <= max_images[a]) sets.Unite(a, b);
  }
  std::vector<uint32_t> first_of_set(graph.num_images, graph.num_images);
  std::vector<uint32_t> group(graph.num_images);
  for (uint32_t image = 0; image < graph.num_images; ++image) {
    uint32_t& first = first_of_set[sets.Find(image)];
    first = std::min(first, image);
    group[image] = first;
  }
  return group;
}

}  // namespace orbweave
