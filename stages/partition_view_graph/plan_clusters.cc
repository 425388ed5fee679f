// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/partition_view_graph/plan_clusters.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/graph/positions_by_motion.h"
#include "core/graph/shared_images.h"
#include "core/scene/places_in_drives.h"

namespace orbweave {

namespace {

/// Beyond so many captures nobody looks along a drive (kReachAlongLine, FindUnevenStops).
constexpr uint32_t kOutOfSight = 16;

/// Ranks, not places: an image that is added elsewhere leaves the recipe as it is. Captures that
/// are not of the cluster count, kOutOfSight at most: where a street was driven there and back, the
/// drive leaves the cluster and returns, and its images are no neighbours there.
std::vector<uint32_t> RanksOf(const ClusterRecipe& recipe, const PlacesInDrives& places) {
  std::vector<size_t> order(recipe.images.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::ranges::sort(order, {}, [&](size_t i) {
    return std::pair(recipe.drives[i], places.PlaceOf(recipe.images[i].image));
  });
  std::vector<uint32_t> ranks(order.size(), 0);
  for (size_t i = 1; i < order.size(); ++i) {
    if (recipe.drives[order[i]] != recipe.drives[order[i - 1]]) continue;
    const ImagePair step{recipe.images[order[i - 1]].image, recipe.images[order[i]].image};
    ranks[order[i]] = ranks[order[i - 1]] + std::min(*places.CapturesBetween(step), kOutOfSight);
  }
  return ranks;
}

}  // namespace

std::vector<ClusterRecipe> PlanClusters(const Partition& partition,
                                        const ViewGraph& graph,
                                        const ImageManifest& manifest,
                                        const std::vector<Digest>& features,
                                        const std::map<ImagePair, Digest>& blob_of_pair) {
  const auto clusters_of_image = ClustersOfImages(partition.clusters, graph.num_images);
  std::vector<ClusterRecipe> recipes(partition.clusters.size());
  const std::vector<PositionByMotion> positions = PositionsByMotion(manifest);
  for (uint32_t c = 0; c < recipes.size(); ++c) {
    recipes[c].cluster = c;
    for (const ImageId id : partition.clusters[c].images) {
      recipes[c].images.push_back({id, features[id.value]});
      recipes[c].drives.push_back(manifest.At(id).drive);
      const PosePrior& prior = positions[id.value].prior;
      if (prior.position_in_enu) {
        recipes[c].fixes.push_back({.image = id,
                                    .position_in_enu = *prior.position_in_enu,
                                    .horizontal_sigma_m = prior.horizontal_sigma_m,
                                    .vertical_sigma_m = prior.vertical_sigma_m,
                                    .is_of_drive = positions[id.value].is_of_drive});
      }
    }
  }
  const PlacesInDrives places(manifest);
  for (ClusterRecipe& recipe : recipes) recipe.ranks = RanksOf(recipe, places);
  for (ClusterRecipe& recipe : recipes) recipe.shared = SharedImages(partition, recipe.cluster);
  std::vector<std::set<Digest>> blobs(recipes.size());
  for (const ViewEdge& edge : graph.edges) {
    const auto& of_a = clusters_of_image[edge.pair.a.value];
    const auto& of_b = clusters_of_image[edge.pair.b.value];
    for (const uint32_t c : of_a) {
      if (std::find(of_b.begin(), of_b.end(), c) == of_b.end()) continue;
      recipes[c].pairs.push_back(edge.pair);
      blobs[c].insert(blob_of_pair.at(edge.pair));
    }
  }
  for (size_t c = 0; c < recipes.size(); ++c)
    recipes[c].matches.assign(blobs[c].begin(), blobs[c].end());
  return recipes;
}

}  // namespace orbweave
