// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/plan_recipes.h"

#include <algorithm>
#include <iterator>
#include <set>

#include "core/base/status.h"

namespace orbweave {

std::vector<ExtractRecipe> PlanExtraction(const ImageManifest& manifest) {
  std::vector<ExtractRecipe> recipes;
  recipes.reserve(manifest.images.size());
  for (const ImageRecord& image : manifest.images) {
    recipes.push_back({image.content, image.mask, manifest.mask_ignores_white});
  }
  return recipes;
}

std::vector<MatchRecipe> PlanMatching(std::vector<MatchRecipe::Pair> pairs,
                                      const std::vector<Digest>& features,
                                      size_t pairs_per_task) {
  ORBWEAVE_CHECK(pairs_per_task > 0);
  std::vector<MatchRecipe> recipes;
  for (size_t begin = 0; begin < pairs.size(); begin += pairs_per_task) {
    const size_t end = std::min(begin + pairs_per_task, pairs.size());
    MatchRecipe recipe;
    recipe.pairs.assign(std::make_move_iterator(pairs.begin() + static_cast<std::ptrdiff_t>(begin)),
                        std::make_move_iterator(pairs.begin() + static_cast<std::ptrdiff_t>(end)));
    std::set<ImageId> images;
    for (const MatchRecipe::Pair& pair : recipe.pairs) images.insert({pair.pair.a, pair.pair.b});
    for (const ImageId id : images) recipe.images.push_back({id, features[id.value]});
    recipes.push_back(std::move(recipe));
  }
  return recipes;
}

std::vector<ImageId> SharedImages(const Partition& partition, uint32_t cluster) {
  std::set<ImageId> shared;
  for (const Seam& seam : partition.seams) {
    if (seam.cluster_a == cluster || seam.cluster_b == cluster)
      shared.insert(seam.shared.begin(), seam.shared.end());
  }
  return {shared.begin(), shared.end()};
}

std::vector<ClusterRecipe> PlanClusters(const Partition& partition,
                                        const ViewGraph& graph,
                                        const ImageManifest& manifest,
                                        const std::vector<Digest>& features,
                                        const std::map<ImagePair, Digest>& blob_of_pair) {
  std::vector<std::vector<uint32_t>> clusters_of_image(graph.num_images);
  std::vector<ClusterRecipe> recipes(partition.clusters.size());
  for (uint32_t c = 0; c < recipes.size(); ++c) {
    recipes[c].cluster = c;
    for (const ImageId id : partition.clusters[c].images) {
      recipes[c].images.push_back({id, features[id.value]});
      const PosePrior& prior = manifest.At(id).prior;
      if (prior.position_in_enu) {
        recipes[c].fixes.push_back(
            {id, *prior.position_in_enu, prior.horizontal_sigma_m, prior.vertical_sigma_m});
      }
      clusters_of_image[id.value].push_back(c);
    }
  }
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

std::vector<std::vector<Digest>> PlanSeams(const Partition& partition,
                                           const std::vector<Digest>& rims) {
  std::vector<std::vector<Digest>> recipes;
  for (const Digest& rim : rims) recipes.push_back({rim});
  for (const Seam& seam : partition.seams) recipes[seam.cluster_a].push_back(rims[seam.cluster_b]);
  return recipes;
}

}  // namespace orbweave
