// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_length_faults.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace orbweave {
namespace {

constexpr uint32_t kImages = 20;

std::vector<std::vector<ImageId>> OneDrive() {
  std::vector<ImageId> drive;
  for (uint32_t i = 0; i < kImages; ++i) drive.push_back(ImageId(i));
  return {drive};
}

/// Pairs of each image with the three after it; 70 % of the rays of each agree.
std::vector<PairLength> RightLengths() {
  std::vector<PairLength> pairs;
  for (uint32_t a = 0; a < kImages; ++a) {
    for (uint32_t b = a + 1; b < std::min(a + 4, kImages); ++b)
      pairs.push_back({{ImageId(a), ImageId(b)}, {.told = 100.0, .agreeing = 70.0}});
  }
  return pairs;
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
  EXPECT_TRUE(FindLengthFaults(RightLengths(), OneDrive()).empty());
  EXPECT_TRUE(FindLengthFaults({}, OneDrive()).empty());
  EXPECT_TRUE(FindLengthFaults(RightLengths(), {}).empty());
}

TEST(FindLengthFaults, AnImageIsOneWhoseOwnPairsContradictIt) {
  const auto faults = FindLengthFaults(
      WrongWhere([](uint32_t a, uint32_t b) { return a == 9 || b == 9; }), OneDrive());
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_FALSE(faults[0].next);
  EXPECT_DOUBLE_EQ(faults[0].agreement.Share(), 0.1);
}

TEST(FindLengthFaults, AStreetIsTornWherePairsAcrossContradictIt) {
  const auto is_across = [](uint32_t a, uint32_t b) { return a <= 9 && b > 9; };
  const auto faults = FindLengthFaults(WrongWhere(is_across), OneDrive());
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(9));
  EXPECT_EQ(faults[0].next, ImageId(10));
}

TEST(FindLengthFaults, OnePairThatIsWrongIsNone) {
  const auto is_wrong = [](uint32_t a, uint32_t b) { return a == 9 && b == 10; };
  EXPECT_TRUE(FindLengthFaults(WrongWhere(is_wrong), OneDrive()).empty());
}

TEST(FindLengthFaults, PlacesFollowTheSequenceNotTheNumbers) {
  std::vector<std::vector<ImageId>> drive = OneDrive();
  std::reverse(drive[0].begin(), drive[0].end());
  const auto is_across = [](uint32_t a, uint32_t b) { return a <= 9 && b > 9; };
  const auto faults = FindLengthFaults(WrongWhere(is_across), drive);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].image, ImageId(10));
  EXPECT_EQ(faults[0].next, ImageId(9));
}

TEST(FindLengthFaults, FewRaysAndFewPairsAreNotAsked) {
  std::vector<PairLength> two = RightLengths();
  std::erase_if(two, [](const PairLength& pair) { return pair.pair.a.value > 0; });
  two.pop_back();
  for (PairLength& pair : two) pair.agreement.agreeing = 0.0;
  EXPECT_TRUE(FindLengthFaults(two, OneDrive()).empty());
  std::vector<PairLength> thin = RightLengths();
  for (PairLength& pair : thin) pair.agreement = {.told = 5.0, .agreeing = 0.0};
  EXPECT_TRUE(FindLengthFaults(thin, OneDrive()).empty());
}

}  // namespace
}  // namespace orbweave
