// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/dense/tile_options.h"
#include "stages/list_pairs/plan_matching.h"
#include "stages/list_seams/plan_seams.h"
#include "stages/list_tiles/plan_tiles.h"
#include "stages/partition_view_graph/plan_clusters.h"

namespace orbweave {
namespace {

std::vector<Digest> SomeDigests(uint32_t n) {
  std::vector<Digest> digests;
  for (uint32_t i = 0; i < n; ++i) digests.push_back(DigestOf(std::to_string(i)));
  return digests;
}

TEST(PlanMatching, CutsPairsIntoRunsThatListTheirImages) {
  std::vector<MatchRecipe::Pair> pairs;
  for (uint32_t i = 0; i < 10; ++i) pairs.push_back({{ImageId(i), ImageId(i + 1)}, {}});
  const auto digests = SomeDigests(11);
  const auto recipes = PlanMatching(pairs, digests, {}, 4);
  ASSERT_EQ(recipes.size(), 3U);
  EXPECT_EQ(recipes[0].pairs.size(), 4U);
  EXPECT_EQ(recipes[2].pairs.size(), 2U);
  ASSERT_EQ(recipes[1].images.size(), 5U);
  EXPECT_EQ(recipes[1].images[0].image, ImageId(4));
  EXPECT_EQ(recipes[1].images[0].features, digests[4]);
}

TEST(PlanMatching, MakesNoTaskOfNoPairs) { EXPECT_TRUE(PlanMatching({}, {}, {}, 4).empty()); }

TEST(PlanClusters, GivesEachClusterItsEdgesAndTheirBlobs) {
  ViewGraph graph{.num_images = 5};
  std::map<ImagePair, Digest> blob_of_pair;
  for (uint32_t i = 0; i < 4; ++i) {
    graph.edges.push_back({.pair = {ImageId(i), ImageId(i + 1)}});
    blob_of_pair[graph.edges.back().pair] = DigestOf(i < 2 ? "first" : "second");
  }
  const Partition partition{
      .clusters = {{.images = {ImageId(0), ImageId(1), ImageId(2)}, .interior = {}},
                   {.images = {ImageId(2), ImageId(3), ImageId(4)}, .interior = {}}}};
  ImageManifest manifest;
  for (uint32_t i = 0; i < 5; ++i) manifest.images.push_back({.id = ImageId(i), .drive = i / 3});
  manifest.images[2].prior.position_in_enu = Eigen::Vector3d(1.0, 2.0, 3.0);
  const auto recipes = PlanClusters(partition, graph, manifest, SomeDigests(5), blob_of_pair);
  ASSERT_EQ(recipes.size(), 2U);
  EXPECT_EQ(recipes[1].cluster, 1U);
  EXPECT_EQ(recipes[0].pairs.size(), 2U);
  EXPECT_EQ(recipes[0].matches, std::vector<Digest>{DigestOf("first")});
  EXPECT_EQ(recipes[1].matches, std::vector<Digest>{DigestOf("second")});
  ASSERT_EQ(recipes[1].fixes.size(), 1U);
  EXPECT_EQ(recipes[1].fixes[0].image, ImageId(2));
  EXPECT_EQ(recipes[1].drives, (std::vector<uint32_t>{0, 1, 1}));
  EXPECT_EQ(recipes[1].ranks, (std::vector<uint32_t>{0, 0, 1}));
}

TEST(PlanClusters, RanksImagesByTimeAmongThoseOfTheirDriveInTheCluster) {
  const Partition partition{
      .clusters = {{.images = {ImageId(1), ImageId(2), ImageId(3)}, .interior = {}}}};
  ImageManifest manifest;
  for (uint32_t i = 0; i < 5; ++i)
    manifest.images.push_back({.id = ImageId(i), .capture_time_s = 50.0 - i});
  const auto ranks = [&] {
    return PlanClusters(partition, {.num_images = 5}, manifest, SomeDigests(5), {})[0].ranks;
  };
  EXPECT_EQ(ranks(), (std::vector<uint32_t>{2, 1, 0}));
  manifest.images[4].capture_time_s = 1.0;  // elsewhere in the drive
  EXPECT_EQ(ranks(), (std::vector<uint32_t>{2, 1, 0}));
  for (uint32_t i = 0; i < 5; ++i)
    manifest.images[i].name = std::to_string(i < 3 ? 20 - i : 16 - i) + ".jpg";
  EXPECT_EQ(ranks(), (std::vector<uint32_t>{6, 5, 0})) << "of which 14 to 17 were taken out";
}

/// Where a drive comes back its images of another cluster lie between.
TEST(PlanClusters, ImagesOfOtherClustersLieBetweenThoseOfADrive) {
  Partition partition{.clusters = {{.images = {ImageId(0), ImageId(1), ImageId(6)}}}};
  const auto ranks = [&](uint32_t num_images) {
    ImageManifest manifest;
    for (uint32_t i = 0; i < num_images; ++i) manifest.images.push_back({.id = ImageId(i)});
    return PlanClusters(
               partition, {.num_images = num_images}, manifest, SomeDigests(num_images), {})[0]
        .ranks;
  };
  EXPECT_EQ(ranks(7), (std::vector<uint32_t>{0, 1, 6}));
  partition.clusters[0].images.back() = ImageId(40);
  const std::vector<uint32_t> far_apart = ranks(41);
  partition.clusters[0].images.back() = ImageId(50);
  EXPECT_EQ(ranks(51), far_apart) << "one more far away leaves the recipe as it is";
  EXPECT_GT(far_apart.back(), 10U);
}

TileRuns PointsIn(const std::string& panorama, std::vector<std::pair<TileCell, uint64_t>> counts) {
  TileRuns runs;
  for (const auto& [cell, count] : counts)
    runs.runs.push_back({.cell = cell, .count = count, .points = DigestOf(panorama)});
  return runs;
}

TEST(TilePlanner, CutsATileOfTooManyPointsBetweenPanoramas) {
  TilePlanner planner(100);
  planner.Add(PointsIn("a", {{{0, 0}, 60}, {{1, 0}, 10}}));
  planner.Add(PointsIn("b", {{{0, 0}, 40}}));
  planner.Add(PointsIn("c", {{{-1, 0}, 500}, {{0, 0}, 1}}));
  planner.Add(PointsIn("d", {{{-1, 0}, 1}, {{0, 0}, 99}}));
  const std::vector<TileRecipe> recipes = planner.Recipes();
  ASSERT_EQ(recipes.size(), 5U);
  EXPECT_EQ(recipes[0].cell, (TileCell{-1, 0}));
  EXPECT_EQ(recipes[0].points, std::vector<Digest>{DigestOf("c")});  // more, but one panorama's
  EXPECT_EQ(recipes[1].cell, (TileCell{-1, 0}));
  EXPECT_EQ(recipes[1].piece, 1U);
  EXPECT_EQ(recipes[2].points, (std::vector<Digest>{DigestOf("a"), DigestOf("b")}));
  EXPECT_EQ(recipes[3].points, (std::vector<Digest>{DigestOf("c"), DigestOf("d")}));
  EXPECT_EQ(recipes[3].piece, 1U);
  EXPECT_EQ(recipes[4].cell, (TileCell{1, 0}));
  EXPECT_EQ(recipes[4].piece, 0U);
}

TEST(TilePlanner, NoTaskHoldsATileOfAHundredMillionPoints) {
  const TileOptions options;
  TilePlanner planner(static_cast<uint64_t>(options.max_points));
  constexpr uint64_t kOfAPanorama = 400000;
  for (int k = 0; k < 250; ++k) planner.Add(PointsIn(std::to_string(k), {{{0, 0}, kOfAPanorama}}));
  const std::vector<TileRecipe> recipes = planner.Recipes();
  EXPECT_EQ(recipes.size(), 25U);
  size_t panoramas = 0;
  for (const TileRecipe& recipe : recipes) {
    EXPECT_LE(recipe.points.size() * kOfAPanorama, static_cast<uint64_t>(options.max_points));
    panoramas += recipe.points.size();
  }
  EXPECT_EQ(panoramas, 250U);
}

TEST(TilePlanner, IsNotMisledByCountsThatNobodyCanHave) {
  TilePlanner planner(100);
  planner.Add(PointsIn("a", {{{0, 0}, ~uint64_t{0}}}));
  planner.Add(PointsIn("b", {{{0, 0}, ~uint64_t{0}}}));
  EXPECT_EQ(planner.Recipes().size(), 2U);
}

TEST(PlanSeams, GivesEachClusterItsRimAndThoseOfLaterNeighbours) {
  const Partition partition{.clusters = std::vector<Cluster>(4),
                            .seams = {{.cluster_a = 0, .cluster_b = 1},
                                      {.cluster_a = 0, .cluster_b = 3},
                                      {.cluster_a = 1, .cluster_b = 3}}};
  const std::vector<Digest> boundaries = SomeDigests(4);
  const std::vector<std::vector<Digest>> expected{{boundaries[0], boundaries[1], boundaries[3]},
                                                  {boundaries[1], boundaries[3]},
                                                  {boundaries[2]},
                                                  {boundaries[3]}};
  EXPECT_EQ(PlanSeams(partition, boundaries), expected);
}

}  // namespace
}  // namespace orbweave
