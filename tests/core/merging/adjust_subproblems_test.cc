// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/partitioned_ba/adjust_subproblems.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/merging/divide_world.h"
#include "core/merging/finalise_adjustment.h"
#include "core/synthetic/corridor_options.h"
#include "core/synthetic/make_corridor.h"
#include "tests/core/merging/adjust_globally.h"
#include "tests/core/merging/corridor_model.h"

namespace orbweave {
namespace {

struct World {
  Corridor corridor{};
  Reconstruction model{};
  Georeference georeference{};
};

/// A corridor as clusters and their alignment hand it over, two drives of it where GNSS is used.
World MakeWorld(CorridorShape shape, bool uses_gnss) {
  World world{.corridor =
                  MakeCorridor({.panoramas = 80, .shape = shape, .features_per_panorama = 120})};
  for (ImageRecord& image : world.corridor.manifest.images) image.drive = image.id.value / 40;
  Random random(7);
  world.model = testing::DisturbedModel(testing::TrueModel(world.corridor), 0.02, Sim3{}, random);
  if (uses_gnss) {
    world.georeference = {
        .enu_from_world = Sim3{}, .horizontal_scatter_m = 1.0, .vertical_scatter_m = 2.0};
  }
  return world;
}

std::vector<Subproblem> Divide(const World& world,
                               uint32_t images_per_subproblem,
                               double bias_sigma_m = 2.0) {
  std::map<ImageId, uint32_t> owners;
  for (const auto& [id, image] : world.model.images) owners[id] = id.value / images_per_subproblem;
  return DivideWorld(
      world.model, 0, owners, world.georeference, world.corridor.manifest, bias_sigma_m);
}

AdjustedSubproblems Adjust(std::vector<Subproblem> subproblems, int num_threads = 1) {
  auto adjusted = AdjustSubproblems(std::move(subproblems), {}, {}, {.num_threads = num_threads});
  EXPECT_TRUE(adjusted.ok()) << adjusted.status();
  return std::move(adjusted).value_or(AdjustedSubproblems{});
}

Reconstruction ModelOf(AdjustedSubproblems adjusted) {
  FinalisedWorld world;
  for (const SubproblemSummary& summary : adjusted.summaries)
    world.images.insert(summary.owned_images.begin(), summary.owned_images.end());
  return testing::GatherWorld(world, std::move(adjusted.subproblems));
}

double LargestDistance(const Reconstruction& x, const Reconstruction& y) {
  double largest = 0.0;
  for (const auto& [id, image] : x.images) {
    const Rigid3& other = y.images.at(id).cam_from_world;
    largest = std::max(largest, (image.cam_from_world.Centre() - other.Centre()).norm());
  }
  return largest;
}

class PartitionedAdjustment : public ::testing::TestWithParam<std::pair<CorridorShape, bool>> {};

TEST_P(PartitionedAdjustment, TakesTheStepsOfTheUndivided) {
  const World world = MakeWorld(GetParam().first, GetParam().second);
  const AdjustedSubproblems whole = Adjust(Divide(world, 80));
  const Reconstruction model = ModelOf(whole);
  for (const uint32_t images_per_subproblem : {27U, 13U, 5U}) {
    const AdjustedSubproblems divided = Adjust(Divide(world, images_per_subproblem));
    ASSERT_EQ(divided.report.accepted_costs.size(), whole.report.accepted_costs.size());
    for (size_t phase = 0; phase < whole.report.accepted_costs.size(); ++phase) {
      const std::vector<double>& expected = whole.report.accepted_costs[phase];
      const std::vector<double>& costs = divided.report.accepted_costs[phase];
      ASSERT_EQ(costs.size(), expected.size()) << images_per_subproblem << ", phase " << phase;
      for (size_t i = 0; i < costs.size(); ++i)
        EXPECT_NEAR(costs[i] / expected[i], 1.0, 1e-9) << images_per_subproblem << ", step " << i;
    }
    EXPECT_EQ(divided.report.removed_observations, whole.report.removed_observations);
    EXPECT_LT(LargestDistance(ModelOf(divided), model), 1e-6);
    EXPECT_EQ(ModelOf(divided).NumObservations(), model.NumObservations());
  }
}

INSTANTIATE_TEST_SUITE_P(Streets,
                         PartitionedAdjustment,
                         ::testing::Values(std::pair(CorridorShape::kBends, true),
                                           std::pair(CorridorShape::kStraight, true),
                                           std::pair(CorridorShape::kLoop, false),
                                           std::pair(CorridorShape::kGrid, true)));

TEST(AdjustSubproblems, SameBytesForAnyNumberOfThreads) {
  const World world = MakeWorld(CorridorShape::kBends, true);
  const Reconstruction one = ModelOf(Adjust(Divide(world, 16), 1));
  const Reconstruction three = ModelOf(Adjust(Divide(world, 16), 3));
  EXPECT_EQ(LargestDistance(one, three), 0.0);
}

TEST(DivideWorld, GivesEveryTermToOneSubproblemAndEveryImageOneOwner) {
  for (const CorridorShape shape : {CorridorShape::kBends, CorridorShape::kGrid}) {
    const World world = MakeWorld(shape, true);
    size_t observations = 0;
    size_t priors = 0;
    std::map<ImageId, int> owners;
    std::map<uint32_t, int> counted_biases;
    for (const Subproblem& subproblem : Divide(world, 9)) {
      observations += subproblem.scene.NumObservations();
      for (const SplitTrack& track : subproblem.split)
        observations += track.part.observations.size();
      priors += subproblem.priors.size();
      for (const SubproblemImage& image : subproblem.images)
        owners[image.id] += subproblem.Owns(image) ? 1 : 0;
      for (const SubproblemBias& bias : subproblem.biases)
        counted_biases[bias.group] += std::isfinite(bias.sigma_m) ? 1 : 0;
    }
    EXPECT_EQ(observations, world.model.NumObservations());
    EXPECT_EQ(priors, world.model.images.size());
    for (const auto& [id, count] : owners) EXPECT_EQ(count, 1);
    for (const auto& [group, count] : counted_biases) EXPECT_EQ(count, 1);
    EXPECT_EQ(counted_biases.size(), 2U);
  }
}

TEST(DivideWorld, MovesNoBiasWhereThereShallBeNone) {
  const World world = MakeWorld(CorridorShape::kBends, true);
  const AdjustedSubproblems adjusted = Adjust(Divide(world, 9, 0.0));
  EXPECT_EQ(ModelOf(adjusted).images.size(), world.model.images.size());
  for (const Subproblem& subproblem : adjusted.subproblems) {
    EXPECT_FALSE(subproblem.biases.empty());
    for (const SubproblemBias& bias : subproblem.biases) EXPECT_TRUE(bias.value_m.isZero());
  }
}

TEST(DivideWorld, LeavesOutWhatLooseImagesSee) {
  World world = MakeWorld(CorridorShape::kBends, false);
  world.model.images.at(ImageId(20)).loose = true;
  for (const Subproblem& subproblem : Divide(world, 9)) {
    for (const Track& track : subproblem.scene.tracks) {
      for (const Observation& seen : track.observations) EXPECT_NE(seen.ref.image, ImageId(20));
    }
  }
  const Reconstruction model = ModelOf(Adjust(Divide(world, 9)));
  EXPECT_TRUE(model.images.at(ImageId(20)).loose);
  EXPECT_EQ(model.images.size(), world.model.images.size());
}

}  // namespace
}  // namespace orbweave
