// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/align_submodels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/merging/alignment/alignment.h"
#include "core/synthetic/make_street.h"
#include "tests/core/merging/align_all.h"
#include "tests/core/merging/split_world.h"

namespace orbweave {
namespace {

using testing::SplitWorld;

Alignment Aligned(const std::vector<Submodel>& submodels, const StageContext& context = {}) {
  const auto alignment = testing::AlignAll(submodels, {}, context);
  EXPECT_TRUE(alignment.ok()) << alignment.status();
  return alignment.ok() ? *alignment : Alignment{};
}

SplitWorld StraightWorld(double noise_m, uint64_t seed) {
  Random random(seed);
  Reconstruction street = testing::MakeStreet(testing::StraightLine(62, 2.0), random);
  return testing::Split(std::move(street), 5, 10, 22, noise_m, random);
}

SplitWorld LoopWorld(double noise_m, uint64_t seed) {
  Random random(seed);
  Reconstruction street = testing::MakeStreet(testing::Circle(72, 2.0), random);
  return testing::Split(std::move(street), 6, 12, 20, noise_m, random);
}

const SeamReport* FindSeam(const Alignment& alignment, uint32_t a, uint32_t b) {
  for (const SeamReport& seam : alignment.seams) {
    if (seam.submodel_a == a && seam.submodel_b == b) return &seam;
  }
  return nullptr;
}

TEST(AlignSubmodels, RecoversExactFramesOnAStraightStreet) {
  const SplitWorld world = StraightWorld(0.0, 1);
  EXPECT_LT(testing::WorstCentreError(world, Aligned(world.submodels)), 1e-2);
}

TEST(AlignSubmodels, StaysNearTheTruthWithNoise) {
  const SplitWorld world = StraightWorld(0.005, 2);
  const Alignment alignment = Aligned(world.submodels);
  EXPECT_LT(testing::WorstCentreError(world, alignment, 2), 0.1);
  for (const SeamReport& seam : alignment.seams) {
    EXPECT_TRUE(seam.used) << seam.reason;
    EXPECT_LT(seam.rotation_jump_deg, 0.2);
    EXPECT_LT(seam.condition_number, 1e4);
  }
}

TEST(AlignSubmodels, FixesTheRollOfCollinearCentresByRotations) {
  SplitWorld world = StraightWorld(0.0, 3);
  for (Submodel& submodel : world.submodels) submodel.reconstruction.tracks.clear();
  EXPECT_LT(testing::WorstCentreError(world, Aligned(world.submodels)), 1e-6);
}

TEST(AlignSubmodels, IsNotMisledByWrongTracks) {
  SplitWorld world = StraightWorld(0.002, 4);
  Random random(5);
  for (Submodel& submodel : world.submodels) {
    for (Track& track : submodel.reconstruction.tracks) {
      if (random.Uniform() < 0.3) track.point_in_world += 50.0 * testing::RandomDirection(random);
    }
  }
  const Alignment alignment = Aligned(world.submodels);
  EXPECT_LT(testing::WorstCentreError(world, alignment, 2), 0.1);
  const SeamReport* seam = FindSeam(alignment, 0, 1);
  ASSERT_NE(seam, nullptr);
  EXPECT_LT(seam->inlier_tracks, 0.65 * seam->common_tracks);
  EXPECT_GT(seam->inlier_tracks, 0.35 * seam->common_tracks);
}

TEST(AlignSubmodels, IsNotMisledByMisplacedImages) {
  SplitWorld world = StraightWorld(0.002, 6);
  Random random(7);
  for (const uint32_t image : {10, 13, 17}) {
    RegisteredImage& misplaced = world.submodels[0].reconstruction.images.at(ImageId(image));
    misplaced.cam_from_world.rotation = testing::RandomRotation(random);
  }
  const Alignment alignment = Aligned(world.submodels);
  const SeamReport* seam = FindSeam(alignment, 0, 1);
  ASSERT_NE(seam, nullptr);
  EXPECT_TRUE(seam->used) << seam->reason;
  EXPECT_LT(seam->rotation_jump_deg, 0.2);
}

TEST(AlignSubmodels, ClosesALoop) {
  const SplitWorld world = LoopWorld(0.002, 8);
  const Alignment alignment = Aligned(world.submodels);
  EXPECT_LT(testing::WorstCentreError(world, alignment), 0.1);
  const SeamReport* closing = FindSeam(alignment, 0, 5);
  ASSERT_NE(closing, nullptr);
  EXPECT_TRUE(closing->used) << closing->reason;
}

/// Bends a submodel of LoopWorld about `axis` through the middle of the loop, by its length for
/// every radian of the loop, as far as `reach_rad` from its middle, where it has no images in
/// common with others.
void Bend(size_t m, const Eigen::Vector3d& axis, double reach_rad, SplitWorld& world) {
  Reconstruction& bent = world.submodels[m].reconstruction;
  bent = Transformed(world.submodel_from_street[m].Inverse(), std::move(bent));
  const auto bend = [&](const Eigen::Vector3d& point) {
    const double middle = (static_cast<double>(m) / 3.0 + 5.0 / 18.0) * std::numbers::pi;
    const double along =
        std::remainder(std::atan2(point.y(), point.x()) - middle, 2.0 * std::numbers::pi);
    return Sim3{.rotation = RotationFromVector(std::clamp(along, -reach_rad, reach_rad) * axis)};
  };
  for (auto& [id, image] : bent.images) {
    image.cam_from_world =
        TransformCamera(bend(image.cam_from_world.Centre()), image.cam_from_world);
  }
  for (Track& track : bent.tracks)
    track.point_in_world = bend(track.point_in_world) * track.point_in_world;
  bent = Transformed(world.submodel_from_street[m], std::move(bent));
}

/// A loop of six submodels, all bent in its plane.
SplitWorld BentLoopWorld(double bend_rad, double reach_rad, uint64_t seed) {
  SplitWorld world = LoopWorld(0.0, seed);
  for (size_t m = 0; m < world.submodels.size(); ++m)
    Bend(m, bend_rad * Eigen::Vector3d::UnitZ(), reach_rad, world);
  return world;
}

void ExpectSpread(const Alignment& alignment) {
  double smallest = 1e9;
  double largest = 0.0;
  for (const SeamReport& seam : alignment.seams) {
    EXPECT_TRUE(seam.used) << seam.reason;
    smallest = std::min(smallest, seam.rotation_jump_deg);
    largest = std::max(largest, seam.rotation_jump_deg);
  }
  EXPECT_LT(largest, 3.0 * smallest + 0.05) << "one seam pays for all";
}

TEST(AlignSubmodels, SpreadsTheDriftOfALoop) {
  // Every submodel is bent by half a degree along its length.
  const Alignment alignment = Aligned(BentLoopWorld(0.008, std::numbers::pi, 9).submodels);
  ExpectSpread(alignment);
  for (const SeamReport& seam : alignment.seams) EXPECT_EQ(seam.drift_factor, 1.0);
}

TEST(AlignSubmodels, ClosesALoopOfSubmodelsThatAreBentByMoreThanIsExpected) {
  // By six degrees, where half a degree is expected; what two have in common is rigid.
  const Alignment alignment = Aligned(BentLoopWorld(0.35, 0.15, 9).submodels);
  ExpectSpread(alignment);
  for (const SeamReport& seam : alignment.seams) EXPECT_GT(seam.drift_factor, 2.0);
}

/// How far submodels lie askew to each other, the bent one apart; radians, the worst of all pairs.
double WorstTilt(const SplitWorld& world, const Alignment& alignment, size_t bent) {
  std::vector<Eigen::Vector3d> ups;
  for (size_t m = 0; m < world.submodels.size(); ++m) {
    const Sim3 world_from_street = alignment.world_from_submodel[m] * world.submodel_from_street[m];
    if (m != bent) ups.emplace_back(world_from_street.rotation * Eigen::Vector3d::UnitZ());
  }
  double worst_rad = 0.0;
  for (const Eigen::Vector3d& a : ups) {
    for (const Eigen::Vector3d& b : ups) worst_rad = std::max(worst_rad, AngleBetween(a, b));
  }
  return worst_rad;
}

TEST(AlignSubmodels, DoesNotTiltSubmodelsForOneThatIsBent) {
  // One of six leans by twenty degrees more at its end than at its beginning, across the street.
  constexpr size_t kBent = 3;
  SplitWorld world = LoopWorld(0.0, 9);
  Bend(kBent, 1.17 * Eigen::Vector3d::UnitX(), 0.15, world);
  auto clusters = testing::FitAllSeams(world.submodels);
  ASSERT_TRUE(clusters.ok());
  const auto tilt_with = [&](bool levels) {
    for (size_t m = 0; m < world.submodels.size(); ++m) {
      std::optional<SubmodelLevel>& level = (*clusters)[m].submodels[0].level;
      level.reset();
      if (!levels) continue;
      level = SubmodelLevel{world.submodel_from_street[m].rotation * Eigen::Vector3d::UnitZ(),
                            m == kBent ? 0.2 : 0.055};
    }
    const auto alignment = AlignSubmodels(*clusters, {}, {});
    EXPECT_TRUE(alignment.ok());
    for (const SeamReport& seam : alignment->seams) {
      EXPECT_TRUE(seam.used) << seam.reason;
      EXPECT_GT(seam.drift_factor, 2.0);
    }
    return WorstTilt(world, *alignment, kBent);
  };
  const double without_rad = tilt_with(false);
  EXPECT_GT(without_rad, 0.15);
  EXPECT_LT(tilt_with(true), 0.67 * without_rad) << "a third less, as levels are known to degrees";
}

TEST(AlignSubmodels, SwitchesOffASeamThatTheLoopContradicts) {
  SplitWorld world = LoopWorld(0.002, 10);
  // Submodel 3 believes to have seen the beginning of submodel 0, somewhere beside itself.
  Random random(11);
  Submodel false_place = testing::Cut(world.street, 8, 4, 0.0, random);
  const Sim3 wrong{.rotation = RotationFromVector({0.0, 0.0, 2.0}),
                   .translation = {3.0, 20.0, 1.0}};
  false_place.reconstruction =
      Transformed(world.submodel_from_street[3] * wrong, std::move(false_place.reconstruction));
  Reconstruction& misled = world.submodels[3].reconstruction;
  misled.images.insert(false_place.reconstruction.images.begin(),
                       false_place.reconstruction.images.end());
  std::move(false_place.reconstruction.tracks.begin(),
            false_place.reconstruction.tracks.end(),
            std::back_inserter(misled.tracks));
  misled.SortTracks();

  const Alignment alignment = Aligned(world.submodels);
  const SeamReport* seam = FindSeam(alignment, 0, 3);
  ASSERT_NE(seam, nullptr);
  EXPECT_GT(seam->inlier_tracks, 20U) << "the seam by itself looks right";
  EXPECT_FALSE(seam->used);
  EXPECT_NE(seam->reason.find("contradicted"), std::string::npos) << seam->reason;
  for (uint32_t m = 0; m + 1 < 6; ++m) EXPECT_TRUE(FindSeam(alignment, m, m + 1)->used);
  EXPECT_EQ(seam->drift_factor, 1.0);
  EXPECT_LT(FindSeam(alignment, 2, 3)->position_jump_m, 0.1);
}

TEST(AlignSubmodels, KeepsUnconnectedSubmodelsInWorldsOfTheirOwn) {
  Random random(12);
  SplitWorld world{.street = testing::MakeStreet(testing::StraightLine(60, 2.0), random)};
  for (const auto& [first, count] : {std::pair{0U, 12U}, {30U, 15U}, {8U, 12U}, {40U, 15U}}) {
    world.Add(testing::Cut(world.street, first, count, 0.0, random), random);
  }
  const Alignment alignment = Aligned(world.submodels);
  EXPECT_EQ(alignment.world, (std::vector<uint32_t>{1, 0, 1, 0})) << "world 0 has most images";
  EXPECT_LT(testing::WorstCentreError(world, alignment, 0), 1e-2);
  EXPECT_LT(testing::WorstCentreError(world, alignment, 1), 1e-2);
}

TEST(AlignSubmodels, SaysWhyItDoesNotTrustASeam) {
  Random random(13);
  SplitWorld world{.street = testing::MakeStreet(testing::StraightLine(20, 2.0), random)};
  world.Add(testing::Cut(world.street, 0, 10, 0.0, random), random);
  world.Add(testing::Cut(world.street, 8, 10, 0.0, random), random);
  for (Submodel& submodel : world.submodels) submodel.reconstruction.tracks.clear();
  const Alignment alignment = Aligned(world.submodels);
  ASSERT_EQ(alignment.seams.size(), 1U);
  EXPECT_FALSE(alignment.seams[0].used);
  EXPECT_EQ(alignment.seams[0].reason, "2 common images and 0 common tracks are too few");
  EXPECT_NE(alignment.world[0], alignment.world[1]);
}

TEST(AlignSubmodels, DoesNotBelieveLooseImages) {
  SplitWorld world = StraightWorld(0.0, 14);
  for (uint32_t image = 10; image < 22; ++image) {
    world.submodels[0].reconstruction.images.at(ImageId(image)).loose = true;
  }
  const Alignment alignment = Aligned(world.submodels);
  EXPECT_FALSE(FindSeam(alignment, 0, 1)->used);
}

TEST(AlignSubmodels, DoesNotDependOnTheFramesOfTheSubmodels) {
  const SplitWorld world = StraightWorld(0.005, 15);
  const Alignment before = Aligned(world.submodels);
  SplitWorld moved = world;
  Random random(16);
  const Sim3 moved_from_submodel = testing::RandomFrame(random);
  moved.submodels[3].reconstruction =
      Transformed(moved_from_submodel, std::move(moved.submodels[3].reconstruction));
  const Alignment after = Aligned(moved.submodels);
  const Sim3 frame_before = before.world_from_submodel[1].Inverse() * before.world_from_submodel[3];
  const Sim3 frame_after =
      after.world_from_submodel[1].Inverse() * after.world_from_submodel[3] * moved_from_submodel;
  EXPECT_NEAR(frame_after.scale / frame_before.scale, 1.0, 1e-5);
  EXPECT_LT(testing::RotationError(frame_after.rotation, frame_before.rotation), 1e-5);
}

TEST(AlignSubmodels, GivesTheSameBitsOnAnyNumberOfThreads) {
  const SplitWorld world = LoopWorld(0.005, 17);
  const Alignment one = Aligned(world.submodels, {.num_threads = 1});
  const Alignment three = Aligned(world.submodels, {.num_threads = 3});
  for (size_t m = 0; m < world.submodels.size(); ++m) {
    EXPECT_EQ(one.world_from_submodel[m].scale, three.world_from_submodel[m].scale);
    EXPECT_EQ(one.world_from_submodel[m].translation, three.world_from_submodel[m].translation);
    EXPECT_EQ(one.world_from_submodel[m].rotation.coeffs(),
              three.world_from_submodel[m].rotation.coeffs());
  }
}

TEST(AlignSubmodels, AcceptsNothingOneAndEmptySubmodels) {
  EXPECT_TRUE(Aligned({}).world.empty());
  SplitWorld world = StraightWorld(0.0, 18);
  world.submodels.resize(1);
  EXPECT_EQ(Aligned(world.submodels).world, (std::vector<uint32_t>{0}));
  world.submodels.front().cluster = 1;
  world.submodels.insert(world.submodels.begin(), Submodel{});
  EXPECT_EQ(Aligned(world.submodels).world, (std::vector<uint32_t>{1, 0}));
}

TEST(AlignSubmodels, RefusesASeamOfASubmodelThatIsNotThere) {
  const SplitWorld world = StraightWorld(0.0, 20);
  const std::span<const Submodel> all = world.submodels;
  std::vector<SeamsOfCluster> clusters{FitSeams(all.first(1), all.subspan(1), 8.0, {}).value()};
  ASSERT_FALSE(clusters[0].seams.empty());
  EXPECT_EQ(AlignSubmodels(clusters, {}, {}).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(AlignSubmodels, StopsOnRequest) {
  std::stop_source stop;
  stop.request_stop();
  const auto alignment =
      testing::AlignAll(StraightWorld(0.0, 19).submodels, {}, {.stop = stop.get_token()});
  EXPECT_EQ(alignment.status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace orbweave
