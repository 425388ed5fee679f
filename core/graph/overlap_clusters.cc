// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/overlap_clusters.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/graph/shared_images.h"
#include "core/graph/view_graph_weights.h"

namespace orbweave {
namespace {

using Images = std::vector<uint32_t>;

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
                                  const std::vector<LentImages>& seams) {
  std::vector<Images> members = interiors;
  for (const LentImages& seam : seams) {
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
  const auto clusters_of_image = ClustersOfImages(clusters, num_images);
  std::map<std::pair<uint32_t, uint32_t>, std::vector<ImageId>> shared;
  for (uint32_t image = 0; image < num_images; ++image) {
    const std::vector<uint32_t>& holders = clusters_of_image[image];
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

Partition OverlapClusters(const ViewGraph& graph,
                          const std::vector<Images>& interiors,
                          const OverlapTargets& targets) {
  const std::vector<LentImages> overlap = GrowOverlap(Adjacency(graph.num_images, graph.edges),
                                                      EdgeWeights(graph),
                                                      PartOfImages(graph.num_images, interiors),
                                                      targets);
  Partition partition;
  partition.clusters = MakeClusters(interiors, overlap);
  partition.seams = FindSharedImages(graph.num_images, partition.clusters);
  return partition;
}

}  // namespace orbweave
