// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/graph/disjoint_sets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(DisjointSets, BeginAsSingletons) {
  DisjointSets sets(3);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(sets.Find(i), i);
    EXPECT_EQ(sets.SizeOf(i), 1U);
  }
}

TEST(DisjointSets, UniteTransitivelyAndOnce) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.Unite(0, 1));
  EXPECT_TRUE(sets.Unite(3, 4));
  EXPECT_TRUE(sets.Unite(1, 4));
  EXPECT_FALSE(sets.Unite(0, 3));
  EXPECT_EQ(sets.SizeOf(3), 4U);
  EXPECT_NE(sets.Find(2), sets.Find(0));
}

TEST(DisjointSets, ListElementsBySetTheLargestFirst) {
  using testing::ElementsAre;
  DisjointSets sets(8);
  sets.Unite(7, 2);
  sets.Unite(5, 7);
  sets.Unite(6, 0);
  sets.Unite(4, 1);
  EXPECT_THAT(sets.SetsOf({7, 6, 5, 4, 2, 1, 0}),
              ElementsAre(ElementsAre(2, 5, 7), ElementsAre(0, 6), ElementsAre(1, 4)));
  EXPECT_THAT(sets.SetsOf({3, 7}), ElementsAre(ElementsAre(3), ElementsAre(7)));
  EXPECT_THAT(sets.SetsOf({}), ElementsAre());
}

}  // namespace
}  // namespace orbweave
