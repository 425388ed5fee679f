// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/merge_submodels.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/core/merging/align_all.h"
#include "tests/core/merging/split_world.h"

namespace orbweave {
namespace {

using testing::SplitWorld;

SplitWorld StraightWorld(double noise_m, uint64_t seed) {
  Random random(seed);
  Reconstruction street = testing::MakeStreet(testing::StraightLine(42, 2.0), random);
  return testing::Split(std::move(street), 3, 10, 22, noise_m, random);
}

std::vector<MergedWorld> AlignedAndMerged(const std::vector<Submodel>& submodels) {
  const auto alignment = testing::AlignAll(submodels);
  EXPECT_TRUE(alignment.ok()) << alignment.status();
  return alignment.ok() ? MergeSubmodels(submodels, *alignment) : std::vector<MergedWorld>{};
}

void ExpectLawful(const Reconstruction& merged) {
  std::set<FeatureRef> seen;
  for (size_t t = 0; t < merged.tracks.size(); ++t) {
    const Track& track = merged.tracks[t];
    EXPECT_GE(track.observations.size(), 2U);
    if (t > 0) {
      EXPECT_LT(merged.tracks[t - 1].Name(), track.Name());
    }
    for (size_t i = 0; i < track.observations.size(); ++i) {
      EXPECT_TRUE(merged.images.contains(track.observations[i].ref.image));
      EXPECT_TRUE(seen.insert(track.observations[i].ref).second) << "a feature in two tracks";
      if (i > 0) {
        EXPECT_LT(track.observations[i - 1].ref.image, track.observations[i].ref.image);
      }
    }
  }
}

TEST(MergeSubmodels, GivesBackTheStreetItWasCutFrom) {
  const SplitWorld world = StraightWorld(0.0, 1);
  const auto worlds = AlignedAndMerged(world.submodels);
  ASSERT_EQ(worlds.size(), 1U);
  const Reconstruction& merged = worlds[0].reconstruction;
  ExpectLawful(merged);
  EXPECT_EQ(merged.images.size(), world.street.images.size());
  ASSERT_EQ(merged.tracks.size(), world.street.tracks.size());
  EXPECT_EQ(merged.NumObservations(), world.street.NumObservations());
  EXPECT_EQ(worlds[0].report.conflicting_tracks, 0U);
  EXPECT_GT(worlds[0].report.united_tracks, 200U);
  for (size_t t = 0; t < merged.tracks.size(); ++t) {
    EXPECT_EQ(merged.tracks[t].Name(), world.street.tracks[t].Name());
  }
}

TEST(MergeSubmodels, ReprojectsWithinAFewSigmaWithNoise) {
  const auto worlds = AlignedAndMerged(StraightWorld(0.005, 2).submodels);
  ASSERT_EQ(worlds.size(), 1U);
  const Reconstruction& merged = worlds[0].reconstruction;
  ExpectLawful(merged);
  double sum = 0.0;
  for (const Track& track : merged.tracks) {
    for (const Observation& observation : track.observations) {
      const Rigid3& pose = merged.images.at(observation.ref.image).cam_from_world;
      sum += AngleBetween(pose * track.point_in_world, observation.bearing) / observation.sigma_rad;
    }
  }
  EXPECT_LT(sum / static_cast<double>(merged.NumObservations()), 4.0);
}

TEST(MergeSubmodels, DoesNotDependOnTheFramesOfTheSubmodels) {
  const SplitWorld world = StraightWorld(0.005, 3);
  std::vector<Submodel> moved = world.submodels;
  Random random(4);
  moved[2].reconstruction =
      Transformed(testing::RandomFrame(random), std::move(moved[2].reconstruction));
  const auto before = AlignedAndMerged(world.submodels);
  const auto after = AlignedAndMerged(moved);
  ASSERT_EQ(before.size(), after.size());
  const Reconstruction& x = before[0].reconstruction;
  const Reconstruction& y = after[0].reconstruction;
  ASSERT_EQ(x.tracks.size(), y.tracks.size());
  const double scale = (x.images.at(ImageId(0)).cam_from_world.Centre() -
                        x.images.at(ImageId(41)).cam_from_world.Centre())
                           .norm();
  for (const auto& [id, image] : x.images) {
    EXPECT_LT((image.cam_from_world.Centre() - y.images.at(id).cam_from_world.Centre()).norm(),
              1e-5 * scale);
  }
}

TEST(MergeSubmodels, KeepsWorldsApart) {
  Random random(5);
  SplitWorld world{.street = testing::MakeStreet(testing::StraightLine(40, 2.0), random)};
  world.Add(testing::Cut(world.street, 0, 10, 0.0, random), random);
  world.Add(testing::Cut(world.street, 20, 15, 0.0, random), random);
  world.Add(Submodel{}, random);
  const auto worlds = AlignedAndMerged(world.submodels);
  ASSERT_EQ(worlds.size(), 2U) << "the empty one is none";
  EXPECT_EQ(worlds[0].reconstruction.images.size(), 15U);
  EXPECT_EQ(worlds[1].reconstruction.images.size(), 10U);
  EXPECT_EQ(worlds[0].report.united_tracks, 0U);
}

TEST(MergeSubmodels, AcceptsNothing) { EXPECT_TRUE(MergeSubmodels({}, {}).empty()); }

}  // namespace
}  // namespace orbweave
