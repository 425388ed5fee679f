// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/street_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

constexpr uint32_t kImages = 16;
constexpr double kTolerance_px = 8.0;

/// A street of images 4 m apart of which each sees three before it and three behind.
StreetFixture Street() {
  return StreetFixture(
      {.centres = StraightWalk(kImages, 4.0), .points_per_metre = 8, .reach_m = 30.0, .window = 3});
}

/// The images of the street in lines, which are of these drives.
std::vector<StreetLine> LinesOf(StreetFixture&& street, const std::vector<uint32_t>& drives) {
  for (uint32_t i = 0; i < kImages; ++i) street.world.problem.images[i].drive = drives[i];
  return FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px);
}

std::vector<ImageSlot> InOrder() {
  std::vector<ImageSlot> images(kImages);
  std::iota(images.begin(), images.end(), 0U);
  return images;
}

TEST(FindStreetLines, OneDriveIsOneLineHoweverItsImagesWereRegistered) {
  const StreetFixture street = Street();
  std::vector<ImageSlot> backwards = InOrder();
  std::ranges::reverse(backwards);
  EXPECT_THAT(FindStreetLines(street.StateWith(backwards), kTolerance_px),
              ElementsAre(ElementsAreArray(InOrder())));
}

TEST(FindStreetLines, GoesByRanksWhereTheyAreGiven) {
  StreetFixture street = Street();
  for (uint32_t i = 0; i < kImages; ++i) street.world.problem.images[i].rank_in_drive = kImages - i;
  std::vector<ImageSlot> backwards = InOrder();
  std::ranges::reverse(backwards);
  EXPECT_THAT(FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px),
              ElementsAre(ElementsAreArray(backwards)));
}

TEST(FindStreetLines, EndWhereMoreCapturesAreMissingThanImagesSeeAcross) {
  StreetFixture street = Street();
  for (uint32_t i = 0; i < kImages; ++i)
    street.world.problem.images[i].rank_in_drive = i < 8 ? i : i + 3;
  const auto lines = [&] {
    street.graph = BuildCorrespondenceGraph(street.world.problem).value();
    return FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px);
  };
  EXPECT_EQ(lines().size(), 1U) << "pairs lead across";
  for (TwoViewGeometry& pair : street.world.problem.pairs) {
    if (pair.pair.a.value >= 8 || pair.pair.b.value < 8) continue;
    // What looks alike: no match is where the model has it.
    for (size_t i = 0, j = pair.inliers.size(); i + 1 < j--; ++i)
      std::swap(pair.inliers[i].b, pair.inliers[j].b);
  }
  EXPECT_EQ(lines().size(), 2U);
  for (uint32_t i = 0; i < kImages; ++i) street.world.problem.images[i].rank_in_drive = i;
  EXPECT_EQ(lines().size(), 1U);
}

/// Captures 5 to 10 of a street are of another day, and not in the model; what is before and behind
/// them looks alike, in the direction of the street.
TEST(FindStreetLines, DoNotSkipWhatIsMissingByPairsOfPlacesThatLookAlike) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(kImages, 4.0);
  for (size_t i = 5; i < centres.size(); ++i) centres[i].x() += 24.0;
  StreetFixture street({.centres = centres, .points_per_metre = 8, .reach_m = 30.0, .window = 3});
  for (uint32_t i = 0; i < kImages; ++i)
    street.world.problem.images[i].rank_in_drive = i < 5 ? i : i + 6;
  std::erase_if(street.world.problem.pairs, [](const TwoViewGeometry& pair) {
    return pair.pair.a.value < 5 && pair.pair.b.value >= 5;
  });
  const auto lines = [&] {
    street.graph = BuildCorrespondenceGraph(street.world.problem).value();
    return FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px).size();
  };
  ASSERT_EQ(lines(), 2U);
  TwoViewGeometry alike{.pair = {ImageId(2), ImageId(5)}, .kind = TwoViewKind::kGeneral};
  const ClusterImage& a = street.world.problem.images[2];
  ClusterImage& b = street.world.problem.images[5];
  for (FeatureIndex f = 0; f < 50; ++f) {
    const Eigen::Vector3d step(-4.0, 0.0, 0.0);
    b.bearings[f] = (12.0 * a.bearings[f] + step).normalized();
    alike.inliers.push_back({f, f});
  }
  street.world.problem.pairs.push_back(alike);
  std::ranges::sort(street.world.problem.pairs, {}, &TwoViewGeometry::pair);
  EXPECT_EQ(lines(), 2U);
  for (uint32_t i = 0; i < kImages; ++i) street.world.problem.images[i].rank_in_drive = i;
  EXPECT_EQ(lines(), 1U) << "nothing is missing";
}

TEST(FindStreetLines, StretchesOfTwoDaysAreOneStreet) {
  EXPECT_THAT(LinesOf(Street(), {0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0}),
              ElementsAre(ElementsAreArray(InOrder())));
}

TEST(FindStreetLines, AStretchMayBeOneImage) {
  EXPECT_THAT(LinesOf(Street(), {0, 0, 0, 0, 0, 0, 0, 2, 1, 1, 1, 1, 1, 1, 1, 1}),
              ElementsAre(ElementsAreArray(InOrder())));
}

TEST(FindStreetLines, TheSecondDayMayHaveComeTheOtherWay) {
  StreetFixture street = Street();
  for (uint32_t i = 0; i < kImages; ++i)
    street.world.problem.images[i].rank_in_drive = i < 8 ? i : kImages - i;
  EXPECT_THAT(LinesOf(std::move(street), {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1}),
              ElementsAre(ElementsAreArray(InOrder())));
}

TEST(FindStreetLines, TwoDrivesAlongAStreetAreTwoLines) {
  EXPECT_THAT(
      LinesOf(Street(), {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}),
      ElementsAre(ElementsAre(0, 2, 4, 6, 8, 10, 12, 14), ElementsAre(1, 3, 5, 7, 9, 11, 13, 15)));
}

TEST(FindStreetLines, EndsWhereNoPairLeadsOn) {
  StreetFixture street = Street();
  std::erase_if(street.world.problem.pairs, [](const TwoViewGeometry& pair) {
    return pair.pair.a.value < 6 && pair.pair.b.value >= 6;
  });
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  EXPECT_THAT(
      FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px),
      ElementsAre(ElementsAre(0, 1, 2, 3, 4, 5), ElementsAre(6, 7, 8, 9, 10, 11, 12, 13, 14, 15)));
}

/// Two stretches of a drive 100 m apart, with a pair of their ends that look alike.
TEST(FindStreetLines, EndsWhereGnssHasTheDriveLeftOff) {
  std::vector<Eigen::Vector3d> centres = StraightWalk(kImages, 4.0);
  for (size_t i = 8; i < centres.size(); ++i) centres[i].x() += 100.0;
  StreetFixture street({.centres = centres, .points_per_metre = 8, .reach_m = 30.0, .window = 3});
  TwoViewGeometry& alike = street.world.problem.pairs.emplace_back();
  alike.pair = {ImageId(7), ImageId(8)};
  alike.kind = TwoViewKind::kGeneral;
  for (uint32_t i = 0; i < 50; ++i) alike.inliers.push_back({i, i});
  std::ranges::sort(street.world.problem.pairs, {}, &TwoViewGeometry::pair);
  const auto lines = [&] {
    street.graph = BuildCorrespondenceGraph(street.world.problem).value();
    return FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px);
  };
  EXPECT_THAT(lines(), ElementsAre(ElementsAreArray(InOrder())));
  for (uint32_t i = 0; i < kImages; ++i)
    street.world.problem.images[i].prior = {.position_in_enu = centres[i]};
  EXPECT_THAT(
      lines(),
      ElementsAre(ElementsAre(0, 1, 2, 3, 4, 5, 6, 7), ElementsAre(8, 9, 10, 11, 12, 13, 14, 15)));
}

/// A camera carried through a room, all of whose images see each other, but for two that follow
/// each other at its two ends.
TEST(FindStreetLines, EndsWhereACameraWasCarriedElsewhere) {
  std::vector<Eigen::Vector3d> centres;
  for (int i = 0; i < 30; ++i) centres.emplace_back(i % 6, 0.0, 0.5 * (i / 6));
  std::swap(centres[14], centres[29]);  // from (1, 1) to (5, 2), and back
  StreetFixture room({.centres = centres, .points_per_metre = 40, .reach_m = 10.0, .window = 29});
  const auto lines_of = [&] {
    room.graph = BuildCorrespondenceGraph(room.world.problem).value();
    return FindStreetLines(room.StateWith(FirstImages(30)), kTolerance_px);
  };
  EXPECT_THAT(lines_of(), ElementsAre(ElementsAreArray(FirstImages(30))));
  const auto follow_each_other = [&] {
    return std::ranges::any_of(lines_of(), [](const StreetLine& line) {
      const auto at = std::ranges::find(line, ImageSlot{13});
      return at != line.end() && std::next(at) != line.end() && *std::next(at) == 14U;
    });
  };
  std::vector<TwoViewGeometry>& pairs = room.world.problem.pairs;
  const ImagePair apart{ImageId(13), ImageId(14)};
  const auto pair = std::ranges::find(pairs, apart, &TwoViewGeometry::pair);
  // A pair of what looks alike: no match is where the model has it.
  for (size_t i = 0, j = pair->inliers.size(); i + 1 < j--; ++i)
    std::swap(pair->inliers[i].b, pair->inliers[j].b);
  EXPECT_FALSE(follow_each_other());
  pairs.erase(pair);
  EXPECT_FALSE(follow_each_other());
}

TEST(FindStreetLines, ImagesInNoOrderAreOneStreetAsFarAsPairsTell) {
  // Ids: stretches of four from the middle, the end and the beginning.
  StreetFixture street = Street();
  const std::vector<uint32_t> ranks = {8, 9, 10, 11, 0, 1, 2, 3, 12, 13, 14, 15, 4, 5, 6, 7};
  for (uint32_t i = 0; i < kImages; ++i)
    street.world.problem.images[i].rank_in_drive = 10 * ranks[i];
  const std::vector<StreetLine> lines =
      FindStreetLines(street.StateWith(FirstImages(kImages)), kTolerance_px);
  size_t all = 0;
  for (const StreetLine& line : lines) {
    all += line.size();
    for (size_t i = 0; i + 1 < line.size(); ++i) {
      const auto [low, high] = std::minmax(line[i], line[i + 1]);
      EXPECT_EQ(high - low, 1U);
    }
  }
  EXPECT_EQ(all, kImages);
}

TEST(FindStreetLines, AreNoneOfNoImages) {
  EXPECT_TRUE(FindStreetLines(Street().StateWith({}), kTolerance_px).empty());
}

}  // namespace
}  // namespace orbweave
