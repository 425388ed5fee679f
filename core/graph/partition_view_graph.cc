// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/partition_view_graph.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "core/graph/adjacency.h"
#include "core/graph/disjoint_sets.h"
#include "core/graph/divide_graph.h"
#include "core/graph/forecast_seam.h"
#include "core/graph/overlap_clusters.h"
#include "core/graph/strong_links.h"
#include "core/graph/view_graph_weights.h"

namespace orbweave {
namespace {

using Images = std::vector<uint32_t>;

// Divisions that are tried for seams that hold: cuts move by a street or so each time.
constexpr int kRounds = 4;
// An edge of a weak seam counts as so many of the dearest: nearly any other cut is better.
constexpr double kGlue = 10.0;
// Parts may then cost so much more than the mean, so that a cut can move past what clusters share.
constexpr double kUnevenness = 0.3;
// Rather than to cut where nothing holds, two clusters stay one, each of which may be a fifth
// larger than the usual.
constexpr double kLargestCluster = 2.4;

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

// The smallest part that is left standing: half of what was aimed at.
uint32_t MinPartSize(const PartitionOptions& options) {
  return static_cast<uint32_t>(std::min(options.cluster_size, options.min_cluster_size)) / 2;
}

// Interiors of all clusters, sorted by their first image. `cut_costs`: per edge.
absl::StatusOr<std::vector<Images>> DivideComponents(const ViewGraph& graph,
                                                     const std::vector<double>& cut_costs,
                                                     double unevenness,
                                                     const PartitionOptions& options) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  const std::vector<double> weights = EdgeWeights(graph);
  const StrongLinks strong(adjacency, weights);
  const std::vector<double> costs = ImageCosts(graph);
  std::vector<Images> interiors;
  for (const Images& component : FindComponents(graph)) {
    const ConnectedPiece piece{.adjacency = adjacency,
                               .strong = strong,
                               .edge_weight = weights,
                               .cut_cost = cut_costs,
                               .image_cost = costs,
                               .images = component};
    ORBWEAVE_ASSIGN_OR_RETURN(
        std::vector<Images> parts,
        DivideGraph(
            piece, NumClusters(component.size(), options), MinPartSize(options), unevenness));
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

// Says of each seam whether it should hold.
Partition WithForecasts(const ViewGraph& graph,
                        Partition partition,
                        const PartitionOptions& options) {
  const Adjacency adjacency(graph.num_images, graph.edges);
  for (Seam& seam : partition.seams) {
    const SeamForecast forecast = ForecastSeam(graph,
                                               adjacency,
                                               seam,
                                               partition.clusters[seam.cluster_a],
                                               partition.clusters[seam.cluster_b]);
    seam.weakness = WeaknessOf(forecast, options.max_condition);
  }
  return partition;
}

Partition Overlapped(const ViewGraph& graph,
                     const std::vector<Images>& interiors,
                     const std::vector<OverlapRequest>& requests,
                     const PartitionOptions& options) {
  return WithForecasts(
      graph, OverlapClusters(graph, interiors, TargetsOf(requests, options)), options);
}

// Seams that should not hold and whose clusters hang together by no other that should.
std::vector<const Seam*> FindWeakSeams(const Partition& partition) {
  DisjointSets held(static_cast<uint32_t>(partition.clusters.size()));
  for (const Seam& seam : partition.seams) {
    if (seam.weakness.empty()) held.Unite(seam.cluster_a, seam.cluster_b);
  }
  std::vector<const Seam*> weak;
  for (const Seam& seam : partition.seams) {
    if (held.Find(seam.cluster_a) != held.Find(seam.cluster_b)) weak.push_back(&seam);
  }
  return weak;
}

// Makes it dear to cut among the shared images of weak seams.
void Glue(const ViewGraph& graph,
          const std::vector<const Seam*>& weak,
          std::vector<double>& cut_costs) {
  const double dear = kGlue * *std::ranges::max_element(cut_costs);
  for (const Seam* const seam : weak) {
    const auto is_shared = [&](ImageId image) {
      return std::ranges::binary_search(seam->shared, image);
    };
    for (size_t e = 0; e < graph.edges.size(); ++e) {
      if (is_shared(graph.edges[e].pair.a) && is_shared(graph.edges[e].pair.b)) cut_costs[e] = dear;
    }
  }
}

std::vector<Images> InteriorsOf(const Partition& partition) {
  std::vector<Images> interiors;
  for (const Cluster& cluster : partition.clusters) {
    Images& interior = interiors.emplace_back();
    for (const ImageId image : cluster.interior) interior.push_back(image.value);
  }
  return interiors;
}

// Undoes cuts whose seams are weak, first to last, where the cluster stays within its bound.
Partition JoinAcrossWeakSeams(const ViewGraph& graph,
                              Partition partition,
                              const PartitionOptions& options) {
  const auto bound = static_cast<size_t>(kLargestCluster * options.cluster_size);
  while (true) {
    const std::vector<const Seam*> weak = FindWeakSeams(partition);
    std::vector<Images> interiors = InteriorsOf(partition);
    const auto fits = [&](const Seam* seam) {
      return interiors[seam->cluster_a].size() + interiors[seam->cluster_b].size() <= bound;
    };
    const auto seam = std::ranges::find_if(weak, fits);
    if (seam == weak.end()) return partition;
    Images& joined = interiors[(*seam)->cluster_a];
    std::ranges::copy(interiors[(*seam)->cluster_b], std::back_inserter(joined));
    std::ranges::sort(joined);
    interiors.erase(interiors.begin() + (*seam)->cluster_b);
    std::ranges::sort(interiors);
    partition = Overlapped(graph, interiors, {}, options);
  }
}

}  // namespace

uint32_t NumClusters(size_t num_images, const PartitionOptions& options) {
  if (options.cluster_size == 0) return 1;
  const uint32_t by_size = NumClustersBySize(num_images, options.cluster_size);
  const auto sufficient =
      static_cast<uint32_t>(num_images) / static_cast<uint32_t>(options.min_cluster_size);
  const uint32_t by_count = std::min(static_cast<uint32_t>(options.min_clusters), sufficient);
  return std::max({by_size, by_count, 1U});
}

absl::StatusOr<Partition> PartitionViewGraph(const ViewGraph& graph,
                                             const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  std::vector<double> cut_costs = EdgeWeights(graph);
  std::optional<Partition> best;
  size_t fewest = 0;
  for (int round = 0; round < kRounds; ++round) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        const std::vector<Images> interiors,
        DivideComponents(graph, cut_costs, round == 0 ? kUsualUnevenness : kUnevenness, options));
    Partition partition = Overlapped(graph, interiors, {}, options);
    const std::vector<const Seam*> weak = FindWeakSeams(partition);
    const bool is_whole = weak.empty();
    if (!is_whole) Glue(graph, weak, cut_costs);
    if (!best || weak.size() < fewest) {
      fewest = weak.size();
      best = std::move(partition);
    }
    if (is_whole) break;
  }
  return JoinAcrossWeakSeams(graph, *std::move(best), options);
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
  return Overlapped(graph, interiors, {}, options);
}

absl::StatusOr<Partition> WidenOverlaps(const ViewGraph& graph,
                                        const Partition& partition,
                                        const std::vector<OverlapRequest>& requests,
                                        const PartitionOptions& options) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEdges(graph));
  return Overlapped(graph, InteriorsOf(partition), requests, options);
}

}  // namespace orbweave
