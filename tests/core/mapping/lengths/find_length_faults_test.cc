// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/find_length_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbweave {
namespace {

constexpr uint32_t kImages = 20;

/// Pairs of each image with the three after it; 70 % of the rays of each agree.
std::vector<PairLength> RightLengths() {
  std::vector<PairLength> pairs;
  for (uint32_t a = 0; a < kImages; ++a) {
    for (uint32_t b = a + 1; b < std::min(a + 4, kImages); ++b)
      pairs.push_back({{ImageId(a), ImageId(b)}, {.told = 100.0, .agreeing = 70.0}});
  }
  return pairs;
}

/// The ways from each image to the next; 70 % of the rays of each agree.
std::vector<GapLength> RightGaps() {
  std::vector<GapLength> gaps;
  for (uint32_t a = 0; a + 1 < kImages; ++a)
    gaps.push_back({{ImageId(a), ImageId(a + 1)}, 6, {.told = 300.0, .agreeing = 210.0}});
  return gaps;
}

/// 10 % of the rays agree of those pairs of which `is_wrong` holds.
template <typename Predicate>
std::vector<PairLength> WrongWhere(const Predicate& is_wrong) {
  std::vector<PairLength> pairs = RightLengths();
  for (PairLength& pair : pairs) {
    if (is_wrong(pair.pair.a.value, pair.pair.b.value)) pair.agreement.agreeing = 10.0;
  }
  return pairs;
}

TEST(FindLengthFaults, ThereAreNoneWhereRaysAgree) {
  EXPECT_TRUE(FindLengthFaults(RightLengths(), RightGaps()).empty());
  EXPECT_TRUE(FindLengthFaults({}, {}).empty());
}

TEST(FindLengthFaults, AnImageIsOneWhoseOwnPairsContradictIt) {
  const auto faults =
      FindLengthFaults(WrongWhere([](uint32_t a, uint32_t b) { return a == 9 || b == 9; }), {});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_FALSE(faults[0].next);
  EXPECT_DOUBLE_EQ(faults[0].agreement.Share(), 0.1);
}

TEST(FindLengthFaults, AStreetIsTornWhereWhatLeadsAcrossIsContradicted) {
  std::vector<GapLength> gaps = RightGaps();
  gaps[9].agreement.agreeing = 30.0;
  const auto faults = FindLengthFaults(RightLengths(), gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_EQ(faults[0].next, ImageId(10));
  EXPECT_DOUBLE_EQ(faults[0].agreement.Share(), 0.1);
}

TEST(FindLengthFaults, OfWaysThatFollowEachOtherTheWorstIsTorn) {
  std::vector<GapLength> gaps = RightGaps();
  for (const size_t torn : {2U, 3U, 4U, 9U, 10U, 12U}) gaps[torn].agreement.agreeing = 45.0;
  gaps[3].agreement.agreeing = 20.0;
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 3U);
  EXPECT_EQ(faults[0].image, ImageId(3));
  EXPECT_EQ(faults[1].image, ImageId(9));
  EXPECT_EQ(faults[2].image, ImageId(12));
}

/// Most rays near a step that is a fifth too long agree with it, but crowd elsewhere.
TEST(FindLengthFaults, AStreetIsTornWhereClearlyMoreRaysSayAnotherLength) {
  std::vector<GapLength> gaps = RightGaps();
  for (GapLength& gap : gaps) {
    gap.here = 120.0;
    gap.elsewhere = 130.0;  // which is chance
  }
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
  gaps[9].here = 60.0;
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kElsewhere);
  EXPECT_DOUBLE_EQ(faults[0].agreement.told, 190.0);
  EXPECT_DOUBLE_EQ(faults[0].agreement.agreeing, 60.0);
  EXPECT_LT(faults[0].agreement.Share(), faults[0].MinShare());
}

TEST(FindLengthFaults, OneWallOfAStreetSpeaksForItself) {
  std::vector<GapLength> gaps = RightGaps();
  for (GapLength& gap : gaps) gap.wall = {.told = 70.0, .agreeing = 31.0};  // once at a right way
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
  gaps[9].wall = {.told = 177.0, .agreeing = 75.0};
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kWall);
  EXPECT_LT(faults[0].agreement.Share(), faults[0].MinShare());
}

TEST(FindLengthFaults, OneWallHidesNothingBesideIt) {
  std::vector<GapLength> gaps = RightGaps();
  gaps[9].wall = {.told = 100.0, .agreeing = 10.0};
  gaps[10].here = 60.0;
  gaps[10].elsewhere = 132.0;
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(10));
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kElsewhere);
}

TEST(FindLengthFaults, SidesOfAWayHaveOneScale) {
  std::vector<GapLength> gaps = RightGaps();
  for (GapLength& gap : gaps) gap.scale_jump = std::log(3.9);
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
  gaps[9].scale_jump = std::log(25.0);
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kScale);
  EXPECT_NEAR(faults[0].agreement.Share(), 0.04, 1e-12);
  EXPECT_LT(faults[0].agreement.Share(), faults[0].MinShare());
}

TEST(FindLengthFaults, AWayWhoseMatchesDisagreeIsAHinge) {
  std::vector<GapLength> gaps = RightGaps();
  for (GapLength& gap : gaps) gap.matches = {.told = 600.0, .agreeing = 400.0};
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
  gaps[9].matches.agreeing = 60.0;
  gaps[12].matches = {.told = 30.0, .agreeing = 0.0};  // too few to be heard
  const auto faults = FindLengthFaults({}, gaps);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].kind, LengthFaultKind::kHinge);
  EXPECT_DOUBLE_EQ(faults[0].agreement.Share(), 0.1);
  EXPECT_LT(faults[0].agreement.Share(), faults[0].MinShare());
}

TEST(FindLengthFaults, AWayThatIsBorneOutIsNoneUnlessItsSidesStandAskew) {
  std::vector<GapLength> gaps = RightGaps();
  gaps[9].agreement.agreeing = 20.0;
  EXPECT_EQ(FindLengthFaults({}, gaps).size(), 1U);
  gaps[9].is_borne_out = true;
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
  gaps[9].matches = {.told = 600.0, .agreeing = 60.0};
  EXPECT_EQ(FindLengthFaults({}, gaps).size(), 1U);
}

/// What no drive does, and no drive of a hostile worker may keep anybody busy with.
TEST(FindLengthFaults, WaysThatLeadInARingAreOnePlace) {
  std::vector<GapLength> ring;
  for (const auto& [from, to] : {std::pair(1U, 2U), {2U, 3U}, {3U, 1U}, {0U, 1U}}) {
    ring.push_back(
        {.between = {ImageId(from), ImageId(to)}, .matches = {.told = 100.0, .agreeing = 1.0}});
  }
  EXPECT_EQ(FindLengthFaults({}, ring).size(), 1U);
  ring.pop_back();
  EXPECT_EQ(FindLengthFaults({}, ring).size(), 1U);
}

TEST(FindLengthFaults, OnePairThatIsWrongIsNone) {
  const auto is_wrong = [](uint32_t a, uint32_t b) { return a == 9 && b == 10; };
  EXPECT_TRUE(FindLengthFaults(WrongWhere(is_wrong), RightGaps()).empty());
}

TEST(FindLengthFaults, FewRaysAndFewPairsAreNotAsked) {
  std::vector<PairLength> two = RightLengths();
  std::erase_if(two, [](const PairLength& pair) { return pair.pair.a.value > 0; });
  two.pop_back();
  for (PairLength& pair : two) pair.agreement.agreeing = 0.0;
  EXPECT_TRUE(FindLengthFaults(two, {}).empty());
  std::vector<PairLength> thin = RightLengths();
  for (PairLength& pair : thin) pair.agreement = {.told = 5.0, .agreeing = 0.0};
  EXPECT_TRUE(FindLengthFaults(thin, {}).empty());
  std::vector<GapLength> gaps = RightGaps();
  gaps[3] = {gaps[3].between, 2, {.told = 300.0, .agreeing = 0.0}};
  gaps[9] = {gaps[9].between, 6, {.told = 49.0, .agreeing = 0.0}};
  EXPECT_TRUE(FindLengthFaults({}, gaps).empty());
}

}  // namespace
}  // namespace orbweave
