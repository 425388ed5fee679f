// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/uneven_stops.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace orbweave {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr uint32_t kStops = 30;

/// A drive along x whose steps vary by so much.
std::vector<DriveStop> Drive(double varies, uint32_t seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> step(1.0 - varies, 1.0 + varies);
  std::vector<DriveStop> stops;
  double x = 0.0;
  for (uint32_t i = 0; i < kStops; ++i) {
    stops.push_back({i, {x, 0.0, 0.0}});
    x += step(random);
  }
  return stops;
}

std::vector<DriveStop> With(std::vector<DriveStop> stops, size_t stop, double further) {
  stops[stop].centre.x() += further;
  return stops;
}

TEST(FindUnevenStops, FindsNothingInDrivesWhoseStepsVary) {
  for (uint32_t seed = 0; seed < 200; ++seed)
    EXPECT_THAT(FindUnevenStops(Drive(0.2, seed)), IsEmpty()) << seed;
  EXPECT_THAT(FindUnevenStops({}), IsEmpty());
}

TEST(FindVanishedSteps, FindsTheOneWhateverTheScale) {
  for (uint32_t seed = 0; seed < 100; ++seed) {
    std::vector<DriveStop> stops = Drive(0.15, seed);
    EXPECT_THAT(FindVanishedSteps(stops), IsEmpty()) << seed;
    const double length = stops[12].centre.x() - stops[11].centre.x();
    for (size_t i = 12; i < stops.size(); ++i) stops[i].centre.x() -= length - 0.05;
    for (DriveStop& stop : stops) stop.centre *= 1e-3;
    const std::vector<VanishedStep> found = FindVanishedSteps(stops);
    ASSERT_THAT(found, SizeIs(1)) << seed;
    EXPECT_EQ(found[0].stop, 11U);
    EXPECT_NEAR(found[0].share, 0.05, 0.02);
  }
  EXPECT_THAT(FindVanishedSteps({}), IsEmpty());
}

TEST(FindVanishedSteps, FindsOneThatLeadsBackBetweenTwoThatLeadOn) {
  std::vector<DriveStop> stops = Drive(0.1);
  const double length = stops[12].centre.x() - stops[11].centre.x();
  for (size_t i = 12; i < stops.size(); ++i) stops[i].centre.x() -= 2.2 * length;
  const std::vector<VanishedStep> found = FindVanishedSteps(stops);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].stop, 11U);
  EXPECT_NEAR(found[0].share, -1.2, 0.2);
  for (size_t i = 13; i < stops.size(); ++i)  // and goes on that way
    stops[i].centre.x() = 2.0 * stops[12].centre.x() - stops[i].centre.x();
  EXPECT_THAT(FindVanishedSteps(stops), IsEmpty()) << "a camera that turns round and drives back";
}

/// The first and the last of a drive stand beside the next.
std::vector<DriveStop> WithNearEnds() {
  std::vector<DriveStop> stops = Drive(0.1);
  stops.front().centre = stops[1].centre - Eigen::Vector3d(0.2, 0.0, 0.0);
  stops.back().centre = stops[kStops - 2].centre + Eigen::Vector3d(0.2, 0.0, 0.0);
  return stops;
}

TEST(FindVanishedSteps, FindsThemAtTheEndsOfADrive) {
  const std::vector<VanishedStep> found = FindVanishedSteps(WithNearEnds());
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_EQ(found[0].stop, 0U);
  EXPECT_EQ(found[0].end, 0U);
  EXPECT_EQ(found[1].stop, kStops - 2);
  EXPECT_EQ(found[1].end, kStops - 1);
}

TEST(FindVanishedSteps, FindsThemWhereADriveGoesOnFarAway) {
  for (const double away : {2.0, 20.0}) {
    std::vector<DriveStop> stops = Drive(0.05);
    for (size_t i = 0; i < 11; ++i) stops[i].centre.x() -= away;
    for (size_t i = 0; i < 12; ++i) stops[i].centre.x() += 0.8;
    const std::vector<VanishedStep> found = FindVanishedSteps(stops);
    ASSERT_THAT(found, SizeIs(away > 3.0 ? 1 : 0)) << "one that hangs at two is not judged";
    if (found.empty()) continue;
    EXPECT_EQ(found[0].stop, 11U);
    EXPECT_EQ(found[0].end, 11U);
  }
}

TEST(FindUnevenStops, FindsWhoStandsAWindowTooFar) {
  for (const double further : {0.5, -0.5, 0.9, -0.9}) {
    const std::vector<UnevenStop> found = FindUnevenStops(With(Drive(0.05), 11, further));
    ASSERT_THAT(found, SizeIs(1)) << further;
    EXPECT_EQ(found[0].stop, 11U);
    EXPECT_NEAR(found[0].off_steps, std::abs(further), 0.15);
  }
}

TEST(FindUnevenStops, DoesNotDependOnTheScale) {
  std::vector<DriveStop> stops = With(Drive(0.05), 11, 0.5);
  for (DriveStop& stop : stops) stop.centre *= 1e-3;
  EXPECT_THAT(FindUnevenStops(stops), SizeIs(1));
}

TEST(FindUnevenStops, FindsTwoThatMovedTogetherBesideOneThatIsMissing) {
  std::vector<DriveStop> stops = With(With(Drive(0.05), 2, -0.45), 3, -0.45);
  stops.erase(stops.begin() + 1);
  EXPECT_THAT(FindUnevenStops(stops), SizeIs(1));
}

TEST(FindUnevenStops, FindsWhoWasFlungOut) {
  std::vector<DriveStop> stops = Drive(0.05);
  stops[14].centre += Eigen::Vector3d(3.0, -2.0, 0.0);
  const std::vector<UnevenStop> found = FindUnevenStops(stops);
  ASSERT_THAT(found, SizeIs(1));
  EXPECT_EQ(found[0].stop, 14U);
}

TEST(FindUnevenStops, AsksNoCameraThatIsCarriedByHand) {
  EXPECT_THAT(FindUnevenStops(With(Drive(0.7, 3), 11, 0.4)), IsEmpty());
}

TEST(FindUnevenStops, KnowsWhoStopsAndWhoLeavesImagesOut) {
  std::vector<DriveStop> stops = Drive(0.05);
  stops.erase(stops.begin() + 12);  // and nothing tells that it was there
  for (size_t i = 12; i < stops.size(); ++i) --stops[i].place;
  EXPECT_THAT(FindUnevenStops(stops), IsEmpty());
  std::vector<DriveStop> light = Drive(0.05);
  double back = 0.0;
  for (size_t i = 15; i < light.size(); ++i) {
    const double slower = i < 20 ? std::min(0.2 * static_cast<double>(i - 14), 0.9) : 0.0;
    back += slower;
    light[i].centre.x() -= back;
  }
  EXPECT_THAT(FindUnevenStops(light), IsEmpty());
}

TEST(FindUnevenStops, KnowsAVideoThatHasAFrameTwice) {
  const std::vector<DriveStop> right = Drive(0.05);
  std::vector<DriveStop> stops = right;
  for (const size_t twice : {6U, 12U, 17U}) stops[twice].centre = right[twice - 1].centre;
  EXPECT_THAT(FindUnevenStops(stops), IsEmpty());
  for (const size_t near : {6U, 12U, 17U}) stops[near].centre.x() += 0.1;
  EXPECT_THAT(FindUnevenStops(stops), SizeIs(3));
}

TEST(IsBorneOut, ByPositionsThatKnowIt) {
  const UnevenStop uneven{.share = 0.8, .even_share = 0.5};
  const auto at = [](double x, double sigma_m) {
    return PosePrior{.position_in_enu = Eigen::Vector3d(x, 0.0, 0.0),
                     .horizontal_sigma_m = sigma_m};
  };
  EXPECT_TRUE(IsBorneOut(uneven, at(0.0, 1.0), at(16.0, 1.0), at(20.0, 1.0)));
  EXPECT_TRUE(IsBorneOut(uneven, at(0.0, 1.0), at(14.0, 1.0), at(20.0, 1.0)));
  EXPECT_FALSE(IsBorneOut(uneven, at(0.0, 1.0), at(11.0, 1.0), at(20.0, 1.0)));
  EXPECT_FALSE(IsBorneOut(uneven, at(0.0, 4.0), at(16.0, 4.0), at(20.0, 4.0)));
  EXPECT_FALSE(IsBorneOut(uneven, {}, at(16.0, 1.0), at(20.0, 1.0)));
}

}  // namespace
}  // namespace orbweave
