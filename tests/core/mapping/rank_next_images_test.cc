// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/rank_next_images.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(RankNextImages, TakesTheNeighbourBeforeTheDistantImage) {
  const StreetFixture street({.centres = StraightWalk(10, 4.0)});
  const MappingState state = street.TriangulatedStateWith({0, 1, 2});
  const std::vector<uint32_t> min_visible(10, 5);
  const std::vector<ImageSlot> ranked = RankNextImages(state, min_visible);
  ASSERT_GE(ranked.size(), 2U);
  EXPECT_EQ(ranked.front(), 3U);
  for (size_t i = 1; i < ranked.size(); ++i) {
    EXPECT_GE(state.Visible(ranked[i - 1]).Score(), state.Visible(ranked[i]).Score());
  }
}

TEST(RankNextImages, LeavesOutRegisteredAndBlindImages) {
  const StreetFixture street({.centres = StraightWalk(4, 3.0)});
  const MappingState state = street.TriangulatedStateWith({0, 1});
  std::vector<uint32_t> min_visible(4, 1);
  min_visible[2] = std::numeric_limits<uint32_t>::max();
  EXPECT_EQ(RankNextImages(state, min_visible), (std::vector<ImageSlot>{3}));
}

}  // namespace
}  // namespace orbweave
