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
#include "core/graph/grow_overlap.h"

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

// Inliers x spread; an edge with inliers covers one of 64 cells at least.
std::vector<double> EdgeWeights(const ViewGraph& graph) {
  std::vector<double> weights;
  weights.reserve(graph.edges.size());
  for (const ViewEdge& edge : graph.edges) {
    weights.push_back(std::max(1U, edge.num_inliers) * std::max(edge.spread, 1.0 / 64.0));
  }
  return weights;
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

uint32_t NumClusters(size_t num_images, const PartitionOptions& options) {
  if (options.cluster_size == 0) return 1;
  const auto by_size =
      static_cast<uint32_t>(std::lround(static_cast<double>(num_images) / options.cluster_size));
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
                                                     const Adjacency& adjacency,
                                                     const std::vector<double>& weights,
                                                     const PartitionOptions& options) {
  std::vector<Images> interiors;
  for (const Images& component : FindComponents(graph)) {
    const ConnectedPiece piece{.adjacency = adjacency, .edge_weight = weights, .images = component};
    ORBWEAVE_ASSIGN_OR_RETURN(
        std::vector<Images> parts,
        DivideGraph(piece, NumClusters(component.size(), options), MinPartSize(options)));
    std::move(parts.begin(), parts.end(), std::back_inserter(interiors));
  }
  std::sort(interiors.begin(), interiors.end());
  return interiors;
}

std::vector<uint32_t> PartOfImages(uint32_t num_images, const std::vector<Images>& interiors) {
  std::vector<uint32_t> part_of(num_images, 0);
  for (uint32_t part = 0; part < interiors.size(); ++part) {
    for (const uint32_t image : interiors[part]) part_of[image] = part;
  }
  return part_of;
}

std::vector<ImageId> ToImageIds(const Images& images) {
  std::vector<ImageId> ids;
  ids.reserve(images.size());
  for (const uint32_t image : images) ids.emplace_back(image);
  return ids;
}

std::vector<Cluster> MakeClusters(const std::vector<Images>& interiors,
                                  const std::vector<SharedImages>& seams) {
  std::vector<Images> members = interiors;
  for (const SharedImages& seam : seams) {
    Images& a = members[seam.part_a];
    Images& b = members[seam.part_b];
    a.insert(a.end(), seam.lent_to_a.begin(), seam.lent_to_a.end());
    b.insert(b.end(), seam.lent_to_b.begin(), seam.lent_to_b.end());
  }
  std::vector<Cluster> clusters;
  for (size_t part = 0; part < interiors.size(); ++part) {
    Images& images = members[part];
    std::sort(images.begin(), images.end());
    images.erase(std::unique(images.begin(), images.end()), images.end());
    clusters.push_back({.images = ToImageIds(images), .interior = ToImageIds(interiors[part])});
  }
  return clusters;
}

// Every two clusters with an image in common, whichever seam brought it there.
std::vector<Seam> FindSharedImages(uint32_t num_images, const std::vector<Cluster>& clusters) {
  std::vector<std::vector<uint32_t>> clusters_of(num_images);
  for (uint32_t c = 0; c < clusters.size(); ++c) {
    for (const ImageId image : clusters[c].images) clusters_of[image.value].push_back(c);
  }
  std::map<std::pair<uint32_t, uint32_t>, std::vector<ImageId>> shared;
  for (uint32_t image = 0; image < num_images; ++image) {
    const std::vector<uint32_t>& holders = clusters_of[image];
    for (size_t i = 0; i < holders.size(); ++i) {
      for (size_t j = i + 1; j < holders.size(); ++j) {
        shared[{holders[i], holders[j]}].emplace_back(image);
      }
    }
  }
  std::vector<Seam> seams;
  for (auto& [pair, images] : shared) seams.push_back({pair.first, pair.second, std::move(images)});
  return seams;
}

}  // namespace

absl::StatusOr<Partition> PartitionViewGraph(const ViewGraph& graph,
                                             const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  const Adjacency adjacency(graph.num_images, graph.edges);
  const std::vector<double> weights = EdgeWeights(graph);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Images> interiors,
                            DivideComponents(graph, adjacency, weights, options));
  const std::vector<SharedImages> overlap = GrowOverlap(adjacency,
                                                        weights,
                                                        PartOfImages(graph.num_images, interiors),
                                                        static_cast<size_t>(options.overlap));
  Partition partition;
  partition.clusters = MakeClusters(interiors, overlap);
  partition.seams = FindSharedImages(graph.num_images, partition.clusters);
  return partition;
}

}  // namespace orbweave
