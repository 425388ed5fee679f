// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/see_few_others.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbweave {
namespace {

constexpr uint32_t kImages = 20;

/// All pairs of `count` images up to `reach` steps apart.
std::vector<ImagePair> Within(uint32_t reach, uint32_t count = kImages) {
  std::vector<ImagePair> pairs;
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t b = a + 1; b <= a + reach && b < count; ++b)
      pairs.push_back({ImageId(a), ImageId(b)});
  }
  return pairs;
}

/// A drive of `count` panoramas each of which sees the next `reach` with this much evidence.
std::vector<MatchedPair> Drive(uint32_t count, uint32_t reach, double log10_false_alarms) {
  std::vector<MatchedPair> matched;
  for (const ImagePair& pair : Within(reach, count)) {
    matched.push_back(
        {.pair = pair, .kind = TwoViewKind::kGeneral, .log10_false_alarms = log10_false_alarms});
  }
  return matched;
}

TEST(SeeFewOthers, WhereOnlyTheNextIsSeen) {
  EXPECT_TRUE(SeeFewOthers(kImages, Within(5), Drive(kImages, 1, -300.0)));
  EXPECT_FALSE(SeeFewOthers(kImages, Within(5), Drive(kImages, 2, -300.0)));
}

TEST(SeeFewOthers, WhereWhatIsSeenIsInDoubt) {
  EXPECT_TRUE(SeeFewOthers(kImages, Within(5), Drive(kImages, 5, -100.0)));
  std::vector<MatchedPair> predicted = Drive(kImages, 5, -300.0);
  for (MatchedPair& pair : predicted) pair.rung = MatchRung::kGuided;
  EXPECT_TRUE(SeeFewOthers(kImages, Within(5), predicted));
}

TEST(SeeFewOthers, NotWhereTheCameraStands) {
  std::vector<MatchedPair> still = Drive(kImages, 5, -300.0);
  for (MatchedPair& pair : still) pair.kind = TwoViewKind::kPureRotation;
  EXPECT_FALSE(SeeFewOthers(kImages, Within(5), still));
}

TEST(SeeFewOthers, ForMostImages) {
  EXPECT_FALSE(SeeFewOthers(kImages, Within(5), Drive(13, 3, -300.0)));
  EXPECT_TRUE(SeeFewOthers(kImages, Within(5), Drive(9, 3, -300.0)));
}

TEST(SeeFewOthers, NotWhereAllThatWereTriedAreSeen) {
  EXPECT_FALSE(SeeFewOthers(kImages, Within(1), Drive(kImages, 1, -300.0)));
  EXPECT_TRUE(SeeFewOthers(kImages, Within(1), {}));
  EXPECT_FALSE(SeeFewOthers(3, Within(2, 3), Drive(3, 2, -300.0)));
  EXPECT_FALSE(SeeFewOthers(1, {}, {}));
  EXPECT_FALSE(SeeFewOthers(0, {}, {}));
}

}  // namespace
}  // namespace orbweave
