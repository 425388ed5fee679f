// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/match_images/match_image_pair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "tests/support/random_features.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr ImagePair kPair = {ImageId(0), ImageId(1)};
constexpr size_t kLarge = 2000;  ///< features that are matched first
constexpr size_t kSmall = 4000;
constexpr float kLargeScale_px = 20.0F;
constexpr float kSmallScale_px = 2.0F;
constexpr double kDegree = std::numbers::pi / 180.0;

/// What two panoramas have in common.
struct Common {
  size_t large = 0;
  size_t small = 0;
  size_t alike = 0;  ///< large features that look alike, and show different things
};

struct Sides {
  Rigid3 b_from_a{};
  Features a{.camera = {4096, 2048}};
  Features b{.camera = {4096, 2048}};
};

Sides MakeSides(uint64_t seed, const Common& common) {
  Random random(seed);
  Sides sides{.b_from_a = {testing::RandomRotation(random), testing::RandomDirection(random)}};
  const auto add_common = [&](size_t count, float scale_px) {
    for (size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d point = testing::RandomPoint(random, 2.0, 10.0);
      const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
      testing::AppendFeature(sides.a, point.normalized(), descriptor, scale_px);
      testing::AppendFeature(
          sides.b, testing::BearingOf(sides.b_from_a, point), descriptor, scale_px);
    }
  };
  add_common(common.large, kLargeScale_px);
  add_common(common.small, kSmallScale_px);
  for (size_t i = 0; i < common.alike; ++i) {
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    for (Features* side : {&sides.a, &sides.b})
      testing::AppendFeature(*side, testing::RandomDirection(random), descriptor, kLargeScale_px);
  }
  for (Features* side : {&sides.a, &sides.b}) {
    for (size_t i = common.large + common.alike; i < kLarge; ++i)
      testing::AppendFeature(*side,
                             testing::RandomDirection(random),
                             testing::RandomDescriptor(random),
                             kLargeScale_px);
    for (size_t i = common.small; i < kSmall; ++i)
      testing::AppendFeature(*side,
                             testing::RandomDirection(random),
                             testing::RandomDescriptor(random),
                             kSmallScale_px);
  }
  return sides;
}

TwoViewGeometry Match(const Sides& sides) {
  const auto geometry =
      MatchImagePair(kPair, PairSide(sides.a), PairSide(sides.b), {}, {}, {}, {.seed = 1});
  EXPECT_TRUE(geometry.ok()) << geometry.status();
  EXPECT_EQ(geometry->kind, TwoViewKind::kGeneral);
  EXPECT_LT(testing::RotationError(geometry->b_from_a.rotation, sides.b_from_a.rotation),
            0.2 * kDegree);
  EXPECT_LT(AngleBetween(geometry->b_from_a.translation, sides.b_from_a.translation),
            1.0 * kDegree);
  return *geometry;
}

TEST(MatchImagePair, LeavesNoDoubtWhereTheLargestFeaturesHaveMuchInCommon) {
  const TwoViewGeometry geometry = Match(MakeSides(1, {.large = 80, .small = 600}));
  EXPECT_EQ(geometry.rung, MatchRung::kLargest);
  EXPECT_EQ(geometry.num_putative, 80U);
  EXPECT_LE(geometry.log10_false_alarms, kNoDoubt);
  EXPECT_GT(geometry.inliers.size(), 600U);
}

TEST(MatchImagePair, BelievesWhatFewLargeFeaturesShowWhereItPredictsTheOthers) {
  const TwoViewGeometry geometry = Match(MakeSides(2, {.large = 30, .small = 600}));
  EXPECT_EQ(geometry.rung, MatchRung::kLargest);
  EXPECT_EQ(geometry.num_putative, 30U);  // so nothing but the largest was compared
  EXPECT_GT(geometry.log10_false_alarms, kNoDoubt);
  EXPECT_GT(geometry.inliers.size(), 550U);
}

TEST(MatchImagePair, ComparesAllWhereFewLargeFeaturesPredictNothing) {
  const TwoViewGeometry geometry = Match(MakeSides(3, {.large = 30, .small = 0}));
  EXPECT_EQ(geometry.rung, MatchRung::kDescriptors);
}

TEST(MatchImagePair, ComparesMoreWhereMostLargeFeaturesDisagree) {
  const TwoViewGeometry geometry = Match(MakeSides(4, {.large = 30, .small = 600, .alike = 80}));
  EXPECT_GT(geometry.num_putative, 110U);
  EXPECT_LE(geometry.log10_false_alarms, kNoDoubt);
}

/// The same features once more, as facade views show them.
void AddFacades(Sides& sides, uint64_t seed, size_t right) {
  Random random(seed);
  for (Features* side : {&sides.a, &sides.b}) side->view.assign(side->size(), 0);
  for (size_t i = 0; i < right; ++i) {
    const Eigen::Vector3d point = testing::RandomPoint(random, 2.0, 10.0);
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    testing::AppendFeature(sides.a, point.normalized(), descriptor, kSmallScale_px);
    testing::AppendFeature(
        sides.b, testing::BearingOf(sides.b_from_a, point), descriptor, kSmallScale_px);
    for (Features* side : {&sides.a, &sides.b})
      side->view.push_back(static_cast<uint8_t>(1 + 8 * i / right));
  }
}

TEST(MatchImagePair, FindsByFacadesWhatPanoramasHardlyShow) {
  Sides sides = MakeSides(5, {.large = 10, .small = 0, .alike = 40});
  const auto alone =
      MatchImagePair(kPair, PairSide(sides.a), PairSide(sides.b), {}, {}, {}, {.seed = 1});
  EXPECT_EQ(alone->kind, TwoViewKind::kNone);
  const size_t num_plain = sides.a.size();
  AddFacades(sides, 6, 160);
  const TwoViewGeometry geometry = Match(sides);
  EXPECT_EQ(geometry.rung, MatchRung::kFacades);
  EXPECT_GT(geometry.inliers.size(), 150U);
  EXPECT_TRUE(std::ranges::is_sorted(geometry.inliers));
  EXPECT_GE(geometry.inliers.back().a, num_plain);
}

/// Houses that look alike match by their facades wherever they stand.
TEST(MatchImagePair, DoesNotBelieveFacadesAlone) {
  Sides sides = MakeSides(5, {.large = 0, .small = 0, .alike = 40});
  AddFacades(sides, 6, 160);
  const auto geometry =
      MatchImagePair(kPair, PairSide(sides.a), PairSide(sides.b), {}, {}, {}, {.seed = 1});
  EXPECT_EQ(geometry->kind, TwoViewKind::kNone);
}

/// The chain of two pairs over a panorama half way.
PredictedPose PredictedOf(const Sides& sides) {
  const Rigid3 half = Rigid3::FromCentre(sides.b_from_a.rotation, 0.5 * sides.b_from_a.Centre());
  return PredictPose(half, sides.b_from_a * half.Inverse());
}

absl::StatusOr<TwoViewGeometry> MatchAsPredicted(const Sides& sides, const PredictedPose& pose) {
  return MatchImagePair(
      kPair, PairSide(sides.a), PairSide(sides.b), {.predicted = pose}, {}, {}, {.seed = 1});
}

TEST(MatchImagePair, FindsUnderAPredictedTurnWhatSamplesOfFiveDoNot) {
  const Sides sides = MakeSides(8, {.large = 26, .small = 0, .alike = 600});
  const auto alone =
      MatchImagePair(kPair, PairSide(sides.a), PairSide(sides.b), {}, {}, {}, {.seed = 1});
  EXPECT_EQ(alone->kind, TwoViewKind::kNone);
  const auto geometry = MatchAsPredicted(sides, PredictedOf(sides));
  ASSERT_TRUE(geometry.ok()) << geometry.status();
  EXPECT_EQ(geometry->kind, TwoViewKind::kGeneral);
  EXPECT_EQ(geometry->rung, MatchRung::kPropagated);
  EXPECT_LT(testing::RotationError(geometry->b_from_a.rotation, sides.b_from_a.rotation),
            0.3 * kDegree);
  EXPECT_LE(geometry->log10_false_alarms, TwoViewOptions().max_log10_false_alarms);
}

/// What is predicted is no evidence.
TEST(MatchImagePair, BelievesNoPredictionThatMatchesDoNotBearOut) {
  const Sides alike = MakeSides(9, {.large = 3, .small = 0, .alike = 600});
  EXPECT_EQ(MatchAsPredicted(alike, PredictedOf(alike))->kind, TwoViewKind::kNone);
  const Sides sides = MakeSides(1, {.large = 80, .small = 600});
  PredictedPose wrong = PredictedOf(sides);
  wrong.first = wrong.last = -wrong.last;
  EXPECT_EQ(MatchAsPredicted(sides, wrong)->kind, TwoViewKind::kNone);
}

/// Small features in common, so many of each: those of a camera that stands as the first does, and
/// those of one that leans by 30 degrees.
std::pair<Rigid3, Rigid3> AddBoth(Sides& sides, size_t standing, size_t leaning) {
  Random random(11);
  const Rigid3 stands = {Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())),
                         Eigen::Vector3d::UnitX()};
  const Rigid3 leans = {Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())),
                        Eigen::Vector3d(0.6, 0.8, 0.0)};
  for (size_t i = 0; i < standing + leaning; ++i) {
    const Eigen::Vector3d point = testing::RandomPoint(random, 2.0, 10.0);
    const std::vector<uint8_t> descriptor = testing::RandomDescriptor(random);
    testing::AppendFeature(sides.a, point.normalized(), descriptor, kSmallScale_px);
    testing::AppendFeature(sides.b,
                           testing::BearingOf(i < standing ? stands : leans, point),
                           descriptor,
                           kSmallScale_px);
  }
  return {stands, leans};
}

TEST(MatchImagePair, LetsACameraLeanOnlyWhereClearlyMoreSaysSo) {
  for (const size_t leaning : {82, 160}) {
    Sides sides = MakeSides(10, {});
    const auto [stands, leans] = AddBoth(sides, 75, leaning);
    const auto geometry =
        MatchImagePair(kPair, PairSide(sides.a), PairSide(sides.b), {}, {}, {}, {.seed = 1});
    ASSERT_TRUE(geometry.ok()) << geometry.status();
    const Rigid3& right = leaning > 100 ? leans : stands;
    EXPECT_EQ(geometry->rung, leaning > 100 ? MatchRung::kDescriptors : MatchRung::kUpright);
    EXPECT_LT(testing::RotationError(geometry->b_from_a.rotation, right.rotation), 0.3 * kDegree);
  }
}

TEST(MatchImagePair, NeedsFacadesOfBoth) {
  Sides sides = MakeSides(1, {.large = 80, .small = 600});
  AddFacades(sides, 7, 160);
  const Sides plain = MakeSides(1, {.large = 80, .small = 600});
  sides.b = plain.b;
  EXPECT_EQ(Match(sides).rung, MatchRung::kLargest);
}

}  // namespace
}  // namespace orbweave
