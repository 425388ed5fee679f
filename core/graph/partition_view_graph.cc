// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/partition_view_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "core/graph/adjacency.h"
#include "core/graph/disjoint_sets.h"
#include "core/graph/divide_graph.h"
#include "core/graph/overlap_clusters.h"
#include "core/graph/view_graph_weights.h"

namespace orbweave {
namespace {

using Images = std::vector<uint32_t>;

absl::Status CheckEdges(const ViewGraph& graph) {
  for (const ViewEdge& edge : graph.edges) {
    if (edge.pair.a < edge.pair.b && edge.pair.b.value < graph.num_images) continue;
    return absl::InvalidArgumentError("edge (" + std::to_string(edge.pair.a.value) + ", " +
                                      std::to_string(edge.pair.b.value) + ") in a graph of " +
                                      std::to_string(graph.num_images) + " images");
  }
  return absl::OkStatus();
}

// Connected components of two images and more, each sorted, in order of their first image.
std::vector<Images> FindComponents(const ViewGraph& graph) {
  DisjointSets sets(graph.num_images);
  for (const ViewEdge& edge : graph.edges) sets.Unite(edge.pair.a.value, edge.pair.b.value);
  std::map<uint32_t, size_t> component_of_set;
  std::vector<Images> components;
  for (uint32_t image = 0; image < graph.num_images; ++image) {
    if (sets.SizeOf(image) < 2) continue;
    const auto [entry, is_new] = component_of_set.try_emplace(sets.Find(image), components.size());
    if (is_new) components.emplace_back();
    components[entry->second].push_back(image);
  }
  return components;
}

// An even number where that keeps clusters within a fifth of their size.
uint32_t NumClustersBySize(size_t num_images, int cluster_size) {
  constexpr double kTolerance = 0.2;
  const double wanted = static_cast<double>(num_images) / cluster_size;
  const double even = 2.0 * std::round(wanted / 2.0);
  const bool is_near = even > 0.0 && std::abs(wanted / even - 1.0) <= kTolerance;
  return static_cast<uint32_t>(is_near ? even : std::round(wanted));
}

uint32_t NumClusters(size_t num_images, const PartitionOptions& options) {
  if (options.cluster_size == 0) return 1;
  const uint32_t by_size = NumClustersBySize(num_images, options.cluster_size);
  const auto sufficient =
      static_cast<uint32_t>(num_images) / static_cast<uint32_t>(options.min_cluster_size);
  const uint32_t by_count = std::min(static_cast<uint32_t>(options.min_clusters), sufficient);
  return std::max({by_size, by_count, 1U});
}

// The smallest part that is left standing: half of what was aimed at.
uint32_t MinPartSize(const PartitionOptions& options) {
  return static_cast<uint32_t>(std::min(options.cluster_size, options.min_cluster_size)) / 2;
}

// Interiors of all clusters, sorted by their first image.
absl::StatusOr<std::vector<Images>> DivideComponents(const ViewGraph& graph,
                                                     const PartitionOptions& options) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  const std::vector<double> weights = EdgeWeights(graph);
  const std::vector<double> costs = ImageCosts(graph);
  std::vector<Images> interiors;
  for (const Images& component : FindComponents(graph)) {
    const ConnectedPiece piece{
        .adjacency = adjacency, .edge_weight = weights, .image_cost = costs, .images = component};
    ORBWEAVE_ASSIGN_OR_RETURN(
        std::vector<Images> parts,
        DivideGraph(piece, NumClusters(component.size(), options), MinPartSize(options)));
    std::move(parts.begin(), parts.end(), std::back_inserter(interiors));
  }
  std::sort(interiors.begin(), interiors.end());
  return interiors;
}

OverlapTargets TargetsOf(const std::vector<OverlapRequest>& requests,
                         const PartitionOptions& options) {
  OverlapTargets targets{.usual = static_cast<size_t>(options.overlap)};
  for (const OverlapRequest& request : requests) {
    targets.of_parts[{request.cluster_a, request.cluster_b}] = request.images;
  }
  return targets;
}

}  // namespace

absl::StatusOr<Partition> PartitionViewGraph(const ViewGraph& graph,
                                             const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Images> interiors, DivideComponents(graph, options));
  return OverlapClusters(graph, interiors, TargetsOf({}, options));
}

absl::StatusOr<Partition> PartitionByHand(const ViewGraph& graph,
                                          const std::vector<std::string>& cluster_of_image,
                                          const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  std::map<std::string, Images> images_of_cluster;
  for (const Images& component : FindComponents(graph)) {
    for (const uint32_t image : component) {
      images_of_cluster[cluster_of_image.at(image)].push_back(image);
    }
  }
  std::vector<Images> interiors;
  for (auto& [name, images] : images_of_cluster) {
    std::ranges::sort(images);
    interiors.push_back(std::move(images));
  }
  std::ranges::sort(interiors);
  return OverlapClusters(graph, interiors, TargetsOf({}, options));
}

absl::StatusOr<Partition> WidenOverlaps(const ViewGraph& graph,
                                        const Partition& partition,
                                        const std::vector<OverlapRequest>& requests,
                                        const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  std::vector<Images> interiors;
  for (const Cluster& cluster : partition.clusters) {
    Images& interior = interiors.emplace_back();
    for (const ImageId image : cluster.interior) interior.push_back(image.value);
  }
  return OverlapClusters(graph, interiors, TargetsOf(requests, options));
}

}  // namespace orbweave
