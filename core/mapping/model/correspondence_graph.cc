// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/correspondence_graph.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

namespace orbweave {
namespace {

std::string PairName(const ImagePair& pair) {
  return "pair (" + std::to_string(pair.a.value) + ", " + std::to_string(pair.b.value) + ")";
}

/// Per feature, the first feature with exactly the same bearing.
std::vector<FeatureIndex> FirstOfSameBearing(const std::vector<Eigen::Vector3d>& bearings) {
  const auto key = [&](FeatureIndex f) {
    return std::tuple(bearings[f].x(), bearings[f].y(), bearings[f].z(), f);
  };
  std::vector<FeatureIndex> order(bearings.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(
      order.begin(), order.end(), [&](FeatureIndex x, FeatureIndex y) { return key(x) < key(y); });
  std::vector<FeatureIndex> first(bearings.size());
  for (size_t i = 0; i < order.size(); ++i) {
    const bool repeats = i > 0 && bearings[order[i]] == bearings[order[i - 1]];
    first[order[i]] = repeats ? first[order[i - 1]] : order[i];
  }
  return first;
}

void AddNodesOf(const ClusterImage& image, ImageSlot slot, CorrespondenceGraph& graph) {
  const std::vector<FeatureIndex> first = FirstOfSameBearing(image.bearings);
  std::vector<Node>& nodes = graph.node_of_feature.emplace_back(image.bearings.size());
  for (FeatureIndex f = 0; f < nodes.size(); ++f) {
    if (first[f] != f) {
      nodes[f] = nodes[first[f]];
      continue;
    }
    nodes[f] = graph.NumNodes();
    graph.image_of_node.push_back(slot);
    graph.feature_of_node.push_back(f);
    graph.bearing_of_node.push_back(image.bearings[f]);
  }
  graph.first_node.push_back(graph.NumNodes());
}

absl::Status AddNodes(const ClusterProblem& problem, CorrespondenceGraph& graph) {
  graph.first_node.push_back(0);
  for (ImageSlot slot = 0; slot < problem.images.size(); ++slot) {
    const ClusterImage& image = problem.images[slot];
    if (slot > 0 && !(problem.images[slot - 1].id < image.id)) {
      return absl::InvalidArgumentError("images of a cluster are not sorted by id");
    }
    if (image.sigma_rad.size() != image.bearings.size() ||
        image.colors.size() != image.bearings.size()) {
      return absl::InvalidArgumentError("image " + std::to_string(image.id.value) +
                                        ": one sigma and one colour per bearing are needed");
    }
    AddNodesOf(image, slot, graph);
  }
  return absl::OkStatus();
}

absl::Status AddPairs(const ClusterProblem& problem, CorrespondenceGraph& graph) {
  graph.pairs_of_image.resize(problem.images.size());
  for (uint32_t i = 0; i < problem.pairs.size(); ++i) {
    const TwoViewGeometry& geometry = problem.pairs[i];
    if (geometry.kind == TwoViewKind::kNone || geometry.inliers.empty()) continue;
    const auto a = SlotOf(problem, geometry.pair.a);
    const auto b = SlotOf(problem, geometry.pair.b);
    if (!a || !b || *a >= *b) {
      return absl::InvalidArgumentError(PairName(geometry.pair) +
                                        " does not join two images of the cluster");
    }
    for (const FeatureMatch& match : geometry.inliers) {
      if (match.a >= problem.images[*a].bearings.size() ||
          match.b >= problem.images[*b].bearings.size()) {
        return absl::InvalidArgumentError(PairName(geometry.pair) +
                                          " matches a feature that is not there");
      }
    }
    graph.pairs.push_back({*a, *b, i});
  }
  std::stable_sort(
      graph.pairs.begin(), graph.pairs.end(), [](const LinkedPair& x, const LinkedPair& y) {
        return std::pair(x.a, x.b) < std::pair(y.a, y.b);
      });
  for (uint32_t p = 0; p < graph.pairs.size(); ++p) {
    graph.pairs_of_image[graph.pairs[p].a].push_back(p);
    graph.pairs_of_image[graph.pairs[p].b].push_back(p);
  }
  return absl::OkStatus();
}

void AddNeighbours(const ClusterProblem& problem, CorrespondenceGraph& graph) {
  std::vector<std::pair<Node, Node>> edges;
  for (const LinkedPair& pair : graph.pairs) {
    for (const FeatureMatch& match : problem.pairs[pair.index].inliers) {
      const Node a = graph.node_of_feature[pair.a][match.a];
      const Node b = graph.node_of_feature[pair.b][match.b];
      edges.emplace_back(a, b);
      edges.emplace_back(b, a);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  graph.first_neighbour.assign(graph.NumNodes() + 1, 0);
  for (const auto& edge : edges) ++graph.first_neighbour[edge.first + 1];
  for (Node node = 0; node < graph.NumNodes(); ++node) {
    graph.first_neighbour[node + 1] += graph.first_neighbour[node];
  }
  graph.neighbours.reserve(edges.size());
  for (const auto& edge : edges) graph.neighbours.push_back(edge.second);
}

}  // namespace

std::optional<ImageSlot> SlotOf(const ClusterProblem& problem, ImageId id) {
  const auto it = std::lower_bound(
      problem.images.begin(), problem.images.end(), id, [](const ClusterImage& image, ImageId x) {
        return image.id < x;
      });
  if (it == problem.images.end() || it->id != id) return std::nullopt;
  return static_cast<ImageSlot>(it - problem.images.begin());
}

absl::StatusOr<CorrespondenceGraph> BuildCorrespondenceGraph(const ClusterProblem& problem) {
  CorrespondenceGraph graph;
  ORBWEAVE_RETURN_IF_ERROR(AddNodes(problem, graph));
  ORBWEAVE_RETURN_IF_ERROR(AddPairs(problem, graph));
  AddNeighbours(problem, graph);
  return graph;
}

}  // namespace orbweave
