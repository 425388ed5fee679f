// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/averaging/average_similarities.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/averaging/solve_similarity_graph.h"
#include "core/averaging/spanning_forest.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

DisjointSets Connect(const SimilarityGraph& graph, const std::vector<uint8_t>& is_used) {
  DisjointSets sets(static_cast<uint32_t>(graph.node_length.size()));
  for (size_t e = 0; e < graph.edges.size(); ++e) {
    if (is_used[e] != 0 && graph.edges[e].joins) sets.Unite(graph.edges[e].a, graph.edges[e].b);
  }
  return sets;
}

// Number of each node's connected part, in order of the parts' smallest nodes.
std::vector<uint32_t> NumberParts(const SimilarityGraph& graph) {
  DisjointSets sets = Connect(graph, std::vector<uint8_t>(graph.edges.size(), 1));
  const size_t n = graph.node_length.size();
  constexpr uint32_t kUnnumbered = std::numeric_limits<uint32_t>::max();
  std::vector<uint32_t> part_of_set(n, kUnnumbered);
  std::vector<uint32_t> part(n);
  uint32_t num_parts = 0;
  for (uint32_t i = 0; i < n; ++i) {
    uint32_t& number = part_of_set[sets.Find(i)];
    if (number == kUnnumbered) number = num_parts++;
    part[i] = number;
  }
  return part;
}

// The heaviest node of every part.
std::vector<uint8_t> ChooseFixedNodes(const SimilarityGraph& graph,
                                      const std::vector<uint32_t>& part) {
  std::vector<int64_t> heaviest(part.size(), -1);
  for (size_t i = 0; i < part.size(); ++i) {
    int64_t& best = heaviest[part[i]];
    if (best < 0 || graph.node_weight[i] > graph.node_weight[static_cast<size_t>(best)]) {
      best = static_cast<int64_t>(i);
    }
  }
  std::vector<uint8_t> is_fixed(part.size(), 0);
  for (const int64_t node : heaviest) {
    if (node >= 0) is_fixed[static_cast<size_t>(node)] = 1;
  }
  return is_fixed;
}

// Chains the strongest measurements outward from the fixed nodes.
std::vector<Sim3> ChainForest(const SimilarityGraph& graph, const std::vector<uint8_t>& is_fixed) {
  std::vector<GraphEdge> edges;
  Eigen::VectorXd strength(static_cast<Eigen::Index>(graph.edges.size()));
  for (const SimilarityEdge& edge : graph.edges) {
    strength[static_cast<Eigen::Index>(edges.size())] = edge.strength;
    edges.push_back({edge.a, edge.b});
  }
  std::vector<Sim3> world_from_node(is_fixed.size());
  for (const ForestStep& step : WalkSpanningForest(edges, strength, is_fixed)) {
    const Sim3& a_from_b = graph.edges[step.edge].measured.a_from_b;
    const bool is_forward = step.from == graph.edges[step.edge].a;
    world_from_node[step.to] =
        world_from_node[step.from] * (is_forward ? a_from_b : a_from_b.Inverse());
  }
  return world_from_node;
}

size_t NumContradicted(const SimilarityGraph& graph,
                       const std::vector<double>& error,
                       double max_error) {
  size_t contradicted = 0;
  for (size_t e = 0; e < error.size(); ++e)
    contradicted += graph.edges[e].joins && error[e] > max_error ? 1U : 0U;
  return contradicted;
}

// The edge that is most wrong (then weakest, then first), -1 when none may go.
int64_t WorstEdge(const SimilarityGraph& graph,
                  const std::vector<double>& error,
                  const std::vector<uint8_t>& is_used,
                  double max_error) {
  int64_t worst = -1;
  for (size_t e = 0; e < graph.edges.size(); ++e) {
    if (is_used[e] == 0 || !graph.edges[e].joins || error[e] <= max_error) continue;
    const auto w = static_cast<size_t>(std::max<int64_t>(worst, 0));
    const bool is_worse =
        error[e] > error[w] ||
        (error[e] == error[w] && graph.edges[e].strength < graph.edges[w].strength);
    if (worst >= 0 && !is_worse) continue;
    std::vector<uint8_t> without = is_used;
    without[e] = 0;
    DisjointSets sets = Connect(graph, without);
    if (sets.Find(graph.edges[e].a) == sets.Find(graph.edges[e].b)) worst = static_cast<int64_t>(e);
  }
  return worst;
}

}  // namespace

absl::StatusOr<AveragedSimilarities> AverageSimilarities(const SimilarityGraph& graph,
                                                         const AverageSimilaritiesOptions& options,
                                                         const StageContext& context) {
  AveragedSimilarities result;
  result.part = NumberParts(graph);
  result.is_used.assign(graph.edges.size(), 1);
  const std::vector<uint8_t> is_fixed = ChooseFixedNodes(graph, result.part);
  const std::vector<Sim3> chained = ChainForest(graph, is_fixed);

  SimilaritySolver solver(graph, is_fixed);
  ORBWEAVE_ASSIGN_OR_RETURN(SimilaritySolution best,
                            solver.Solve(chained, result.is_used, options.loss_scale, context));
  SimilaritySolution graduated{.world_from_node = chained};
  for (const double factor : {1000.0, 100.0, 10.0, 1.0}) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        graduated,
        solver.Solve(
            graduated.world_from_node, result.is_used, factor * options.loss_scale, context));
  }
  result.error = solver.Errors(best.world_from_node);
  const std::vector<double> graduated_error = solver.Errors(graduated.world_from_node);
  if (NumContradicted(graph, graduated_error, options.max_error) <
      NumContradicted(graph, result.error, options.max_error)) {
    best = std::move(graduated);
    result.error = graduated_error;
  }
  for (int64_t worst = WorstEdge(graph, result.error, result.is_used, options.max_error);
       worst >= 0;
       worst = WorstEdge(graph, result.error, result.is_used, options.max_error)) {
    result.is_used[static_cast<size_t>(worst)] = 0;
    ORBWEAVE_ASSIGN_OR_RETURN(
        best, solver.Solve(best.world_from_node, result.is_used, options.loss_scale, context));
    result.error = solver.Errors(best.world_from_node);
  }
  result.world_from_node = std::move(best.world_from_node);
  return result;
}

}  // namespace orbweave
