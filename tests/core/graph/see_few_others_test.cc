// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/see_few_others.h"

#include <gtest/gtest.h>

#include <vector>

namespace orbweave {
namespace {

/// A drive of `count` panoramas each of which sees the next `reach` with this much evidence.
std::vector<MatchedPair> Drive(uint32_t count, uint32_t reach, double log10_false_alarms) {
  std::vector<MatchedPair> matched;
  for (uint32_t a = 0; a < count; ++a) {
    for (uint32_t b = a + 1; b <= a + reach && b < count; ++b) {
      matched.push_back({.pair = {ImageId(a), ImageId(b)},
                         .kind = TwoViewKind::kGeneral,
                         .log10_false_alarms = log10_false_alarms});
    }
  }
  return matched;
}

TEST(SeeFewOthers, WhereOnlyTheNextIsSeen) {
  EXPECT_TRUE(SeeFewOthers(20, Drive(20, 1, -300.0)));
  EXPECT_FALSE(SeeFewOthers(20, Drive(20, 2, -300.0)));
}

TEST(SeeFewOthers, WhereWhatIsSeenIsInDoubt) {
  EXPECT_TRUE(SeeFewOthers(20, Drive(20, 5, -100.0)));
  std::vector<MatchedPair> predicted = Drive(20, 5, -300.0);
  for (MatchedPair& pair : predicted) pair.rung = MatchRung::kGuided;
  EXPECT_TRUE(SeeFewOthers(20, predicted));
}

TEST(SeeFewOthers, NotWhereTheCameraStands) {
  std::vector<MatchedPair> still = Drive(20, 5, -300.0);
  for (MatchedPair& pair : still) pair.kind = TwoViewKind::kPureRotation;
  EXPECT_FALSE(SeeFewOthers(20, still));
}

TEST(SeeFewOthers, ForMostImages) {
  EXPECT_FALSE(SeeFewOthers(20, Drive(13, 3, -300.0)));
  EXPECT_TRUE(SeeFewOthers(20, Drive(9, 3, -300.0)));
}

TEST(SeeFewOthers, NotOfFewImagesThatSeeAllOthers) {
  EXPECT_FALSE(SeeFewOthers(3, Drive(3, 2, -300.0)));
  EXPECT_FALSE(SeeFewOthers(2, Drive(2, 1, -300.0)));
  EXPECT_TRUE(SeeFewOthers(2, {}));
  EXPECT_FALSE(SeeFewOthers(1, {}));
  EXPECT_FALSE(SeeFewOthers(0, {}));
}

}  // namespace
}  // namespace orbweave
