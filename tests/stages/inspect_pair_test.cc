// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/match_images/inspect_pair.h"

#include <gmock/gmock.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kSigmaRad = 1e-3;
const ImagePair kPair = {ImageId(3), ImageId(7)};

Features FeaturesOf(const std::vector<Eigen::Vector3d>& bearings) {
  Features features{.camera = {4096, 2048}};
  for (const Eigen::Vector3d& bearing : bearings) {
    const Eigen::Vector2d pixel = features.camera.PixelFromBearing(bearing);
    features.keypoints.push_back(
        {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), 1.0F, 0.0F});
  }
  return features;
}

PairInspection Inspect(const testing::TwoViewWorld& world,
                       const std::optional<TwoViewGeometry>& verified = {},
                       const TwoViewOptions& options = {}) {
  const Features a = FeaturesOf(world.bearings_a);
  const Features b = FeaturesOf(world.bearings_b);
  std::vector<FeatureMatch> matches;
  for (uint32_t i = 0; i < a.size(); ++i) matches.push_back({i, i});
  const auto inspection =
      InspectPair(kPair, PairSide(a), PairSide(b), matches, verified, {}, options, {});
  EXPECT_TRUE(inspection.ok()) << inspection.status();
  return *inspection;
}

TEST(InspectPair, WhatMatchingWouldAcceptIsVerified) {
  const PairInspection inspection = Inspect(testing::MakeTwoViewWorld(1, 300, 0.3, kSigmaRad));
  EXPECT_EQ(inspection.verdict, PairVerdict::kVerified);
  EXPECT_EQ(inspection.num_guided, 0U);
  EXPECT_EQ(inspection.Outliers().size() + inspection.geometry.inliers.size(), 300U);
  // One sigma is 0.65 px of 4096, and the distance to a plane has one component of the noise.
  EXPECT_GT(inspection.residual_px_median, 0.1);
  EXPECT_LT(inspection.residual_px_median, 2.0);
  EXPECT_GT(inspection.spread_in_b, 0.5);
}

TEST(InspectPair, FewerInliersThanAskedForAreShownAndRejected) {
  const testing::TwoViewWorld world = testing::MakeTwoViewWorld(2, 60, 0.3, kSigmaRad);
  const PairInspection inspection = Inspect(world, {}, {.min_inliers = 55});
  EXPECT_EQ(inspection.verdict, PairVerdict::kRejected);
  EXPECT_GE(inspection.geometry.inliers.size(), 30U);
  EXPECT_LT(inspection.geometry.inliers.size(), 55U);
  EXPECT_EQ(inspection.geometry.kind, TwoViewKind::kGeneral);
}

TEST(InspectPair, AHandfulOfMatchesHasNoGeometry) {
  const PairInspection inspection = Inspect(testing::MakeTwoViewWorld(3, 6, 0.0, kSigmaRad));
  EXPECT_EQ(inspection.verdict, PairVerdict::kNothing);
  EXPECT_TRUE(inspection.geometry.inliers.empty());
  EXPECT_EQ(inspection.Outliers().size(), 6U);
}

TEST(InspectPair, WhatTheJobVerifiedIsNotEstimatedAgain) {
  const testing::TwoViewWorld world = testing::MakeTwoViewWorld(4, 100, 0.0, kSigmaRad);
  // The job found one more inlier than is among the putative matches.
  TwoViewGeometry verified{.pair = kPair,
                           .kind = TwoViewKind::kGeneral,
                           .b_from_a = world.b_from_a,
                           .inliers = {{5, 5}, {6, 6}, {7, 8}}};
  const PairInspection inspection = Inspect(world, verified);
  EXPECT_EQ(inspection.verdict, PairVerdict::kVerified);
  EXPECT_EQ(inspection.geometry.inliers, verified.inliers);
  EXPECT_EQ(inspection.num_guided, 1U);
  EXPECT_EQ(inspection.Outliers().size(), 98U);
}

TEST(InspectPair, MatchesOfWallsInTheirTrueShapeAreCountedForThemselves) {
  const testing::TwoViewWorld world = testing::MakeTwoViewWorld(4, 100, 0.0, kSigmaRad);
  Features a = FeaturesOf(world.bearings_a);
  Features b = FeaturesOf(world.bearings_b);
  a.view.assign(a.size(), 0);
  b.view.assign(b.size(), 0);
  for (size_t i = 80; i < a.size(); ++i) a.view[i] = b.view[i] = 1;
  const TwoViewGeometry verified{.pair = kPair,
                                 .kind = TwoViewKind::kGeneral,
                                 .b_from_a = world.b_from_a,
                                 .inliers = {{5, 5}, {7, 8}, {85, 85}, {90, 90}}};
  const auto inspection =
      InspectPair(kPair, PairSide(a), PairSide(b), {{5, 5}, {6, 6}}, verified, {}, {}, {});
  ASSERT_TRUE(inspection.ok()) << inspection.status();
  EXPECT_EQ(inspection->num_guided, 1U);
  EXPECT_EQ(inspection->num_on_facades, 2U);
}

ImageManifest TwoImages() {
  ImageManifest manifest;
  for (uint32_t i = 0; i < 50; ++i) manifest.images.push_back({.id = ImageId{i}});
  return manifest;
}

TEST(WhyNotSelected, NamesTheDistanceInTheSequence) {
  const std::string why = WhyNotSelected(TwoImages(), {ImageId(2), ImageId(27)}, {});
  EXPECT_THAT(why, HasSubstr("25 apart in the sequence (pairs.sequence_window is 10)"));
  EXPECT_THAT(why, HasSubstr("similar"));
}

TEST(WhyNotSelected, SaysOfPairsWithinTheWindowThatTheyWereHeldBack) {
  const std::string why = WhyNotSelected(TwoImages(), {ImageId(2), ImageId(9)}, {});
  EXPECT_THAT(why, HasSubstr("held back"));
  EXPECT_THAT(why, HasSubstr("pairs.first_neighbours"));
}

TEST(WhyNotSelected, CountsAlongTheDriveAndHoldsNothingBackInSmallJobs) {
  ImageManifest manifest = TwoImages();
  for (ImageRecord& image : manifest.images)  // the other way round, but for the last
    image.capture_time_s = image.id.value == 49 ? 1000.0 : 100.0 - image.id.value;
  EXPECT_THAT(WhyNotSelected(manifest, {ImageId(48), ImageId(49)}, {}),
              HasSubstr("49 apart in the sequence"));
  EXPECT_THAT(WhyNotSelected(manifest, {ImageId(0), ImageId(49)}, {}), HasSubstr("held back"));
  manifest = TwoImages();
  manifest.images.resize(30);
  EXPECT_THAT(WhyNotSelected(manifest, {ImageId(2), ImageId(9)}, {}),
              HasSubstr("7 apart in the sequence"));
}

TEST(WhyNotSelected, NamesTheDistanceByGnssWhereBothHaveOne) {
  ImageManifest manifest = TwoImages();
  manifest.images[2].prior.position_in_enu = Eigen::Vector3d(0.0, 0.0, 5.0);
  manifest.images[27].prior.position_in_enu = Eigen::Vector3d(30.0, 40.0, 90.0);
  manifest.images[27].drive = 1;
  const std::string why = WhyNotSelected(manifest, {ImageId(2), ImageId(27)}, {});
  EXPECT_THAT(why, HasSubstr("50.0 m by GNSS (pairs.gnss_radius_m is 20.0 m"));
  EXPECT_THAT(why, HasSubstr("two drives"));
  EXPECT_THAT(why, Not(HasSubstr("similar")));
}

}  // namespace
}  // namespace orbweave
