// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/merging/checks/place_by_sides.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "core/merging/divide_world.h"
#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

constexpr uint32_t kPerCluster = 40;

/// An image that shares no point with another cluster of two.
ImageId FarFromOthers(const Subproblem& subproblem) {
  return subproblem.cluster == 0 ? ImageId(2) : ImageId(2 * kPerCluster - 1);
}

using Placements = std::map<std::pair<ImageId, uint32_t>, SidePlacement>;

/// A corridor in subproblems of kPerCluster panoramas.
std::vector<Subproblem> Subproblems(int num_clusters) {
  const Corridor corridor =
      MakeCorridor({.panoramas = static_cast<int>(kPerCluster) * num_clusters});
  const Reconstruction model = testing::TrueModel(corridor);
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : model.images) owners[id] = id.value / kPerCluster;
  return DivideWorld(model, 0, owners, {.reason = "none"}, corridor.manifest, 2.0);
}

/// Those that two clusters have of one image, summed over the subproblems.
Placements BetweenClusters(const std::vector<Subproblem>& subproblems) {
  Placements sum;
  std::map<ImageId, int> clusters_of_image;
  for (const Subproblem& subproblem : subproblems) {
    for (const SidePlacement& placement : PlaceBySides(subproblem)) {
      const auto [at, is_new] = sum.try_emplace({placement.image, placement.cluster});
      if (is_new) ++clusters_of_image[placement.image];
      at->second.hessian += placement.hessian;
      at->second.gradient += placement.gradient;
      at->second.num_points += placement.num_points;
    }
  }
  std::erase_if(sum, [&](const auto& entry) { return clusters_of_image[entry.first.first] < 2; });
  return sum;
}

/// The same world with all tracks in its first subproblem.
std::vector<Subproblem> WithTracksInOneSubproblem(std::vector<Subproblem> subproblems) {
  Subproblem& first = subproblems.front();
  std::map<ImageId, SubproblemImage> images;
  for (const Subproblem& subproblem : subproblems) {
    for (const SubproblemImage& image : subproblem.images) images.emplace(image.id, image);
    first.scene.images.insert(subproblem.scene.images.begin(), subproblem.scene.images.end());
  }
  first.images.clear();
  for (const auto& [id, image] : images) first.images.push_back(image);
  for (size_t b = 1; b < subproblems.size(); ++b) {
    std::ranges::move(subproblems[b].scene.tracks, std::back_inserter(first.scene.tracks));
    subproblems[b].scene.tracks.clear();
  }
  return subproblems;
}

TEST(PlaceBySides, SumsToTheSameWhicheverSubproblemHasATrack) {
  const std::vector<Subproblem> subproblems = Subproblems(3);
  ASSERT_EQ(subproblems.size(), 3U);
  const Placements apart = BetweenClusters(subproblems);
  const Placements together = BetweenClusters(WithTracksInOneSubproblem(subproblems));
  ASSERT_FALSE(apart.empty());
  ASSERT_EQ(apart.size(), together.size());
  for (const auto& [key, placement] : apart) {
    const SidePlacement& other = together.at(key);
    EXPECT_EQ(placement.num_points, other.num_points);
    EXPECT_LT((placement.hessian - other.hessian).norm(), 1e-9 * other.hessian.norm());
    EXPECT_LT((placement.gradient - other.gradient).norm(), 1e-9 * other.hessian.norm());
  }
}

TEST(PlaceBySides, ListsImagesInOrderAndNoneFromWithinACluster) {
  const std::vector<Subproblem> subproblems = Subproblems(2);
  for (const Subproblem& subproblem : subproblems) {
    const std::vector<SidePlacement> placements = PlaceBySides(subproblem);
    ASSERT_FALSE(placements.empty());
    EXPECT_EQ(std::ranges::count(placements, FarFromOthers(subproblem), &SidePlacement::image), 0);
    for (size_t i = 1; i < placements.size(); ++i) {
      EXPECT_LT(std::pair(placements[i - 1].image, placements[i - 1].cluster),
                std::pair(placements[i].image, placements[i].cluster));
    }
  }
}

TEST(PlaceBySides, HasNothingToSayOfAnUndividedWorld) {
  for (const SidePlacement& placement : PlaceBySides(Subproblems(1).front()))
    EXPECT_EQ(placement.cluster, 0U);  // the held image alone
  EXPECT_LE(PlaceBySides(Subproblems(1).front()).size(), 1U);
}

}  // namespace
}  // namespace orbweave
