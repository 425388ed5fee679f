// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/rank_next_images.h"

#include <gtest/gtest.h>

#include <algorithm>

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
    EXPECT_GE(state.Visible(ranked[i - 1]).Count(), state.Visible(ranked[i]).Count());
  }
}

TEST(RankNextImages, TakesTheNeighbourBeforeALookAlike) {
  // Image 29, far away, has matches with image 2 for two fifths of its features, feature by feature
  // and hence all over the sphere.
  StreetFixture street({.centres = StraightWalk(30, 3.0), .points_per_metre = 20});
  TwoViewGeometry alike{.pair = {ImageId(2), ImageId(29)}, .kind = TwoViewKind::kGeneral};
  const auto features = static_cast<FeatureIndex>(street.world.problem.images[2].bearings.size());
  for (FeatureIndex f = 0; f < features; f += 5) {
    alike.inliers.push_back({f, f});
    alike.inliers.push_back({f + 1, f + 1});
  }
  street.world.problem.images[29] = street.world.problem.images[2];
  street.world.problem.images[29].id = ImageId(29);
  std::erase_if(street.world.problem.pairs,
                [](const TwoViewGeometry& pair) { return pair.pair.b == ImageId(29); });
  street.world.problem.pairs.push_back(alike);
  street.graph = BuildCorrespondenceGraph(street.world.problem).value();
  const MappingState state = street.TriangulatedStateWith({0, 1, 2, 3, 4});
  const std::vector<ImageSlot> ranked = RankNextImages(state, std::vector<uint32_t>(30, 20));
  EXPECT_EQ(ranked.front(), 5U);
  EXPECT_GT(state.Visible(29).Score(), state.Visible(9).Score());
  const auto neighbour = std::ranges::find(ranked, 9U);
  const auto look_alike = std::ranges::find(ranked, 29U);
  ASSERT_NE(look_alike, ranked.end());
  EXPECT_LT(neighbour, look_alike);
  // By score alone, as the paper has it, it is the other way round.
  const std::vector<ImageSlot> by_score =
      RankNextImages(state, std::vector<uint32_t>(30, 20), true);
  EXPECT_GT(std::ranges::find(by_score, 9U), std::ranges::find(by_score, 29U));
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
