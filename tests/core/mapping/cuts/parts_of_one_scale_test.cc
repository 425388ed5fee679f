// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_of_one_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

using ::testing::ElementsAre;
using Parts = std::vector<std::vector<ImageSlot>>;

constexpr uint32_t kImages = 16;
constexpr ImageSlot kHinge = 7;

bool IsBefore(ImageSlot image) { return image < kHinge; }
bool IsBehind(ImageSlot image) { return image > kHinge; }

/// A street in which one image sees both halves: no point is seen from before it and behind it but
/// the first `num_across`, and these if `is_far_away` by a thousand times their distance.
MappingState Hinging(const StreetFixture& street, size_t num_across, bool is_far_away = false) {
  MappingState state = street.TriangulatedStateWith(FirstImages(kImages));
  for (const PointIndex point : AllPoints(state)) {
    const std::vector<ImageSlot> images = ImagesThatSee(state, point);
    const bool is_across =
        std::ranges::any_of(images, IsBefore) && std::ranges::any_of(images, IsBehind);
    if (!is_across) continue;
    const bool tells = images.size() == 3 && images[1] == kHinge;
    if (tells && num_across > 0) {
      --num_across;
      if (is_far_away) state.SetPosition(point, 1000.0 * state.Point(point).position);
    } else {
      state.RemovePoint(point);
    }
  }
  EXPECT_EQ(num_across, 0U);
  return state;
}

StreetFixture Street() {
  return StreetFixture(
      {.centres = StraightWalk(kImages, 12.0), .points_per_metre = 40, .random_rotations = true});
}

std::vector<size_t> SizesOf(const Parts& parts) {
  std::vector<size_t> sizes;
  for (const std::vector<ImageSlot>& part : parts) sizes.push_back(part.size());
  return sizes;
}

TEST(PartsOfOneScale, AStreetIsOne) {
  const StreetFixture street = Street();
  const MappingState state = street.TriangulatedStateWith(FirstImages(kImages));
  EXPECT_EQ(PartsOfOneScale(state, {}), (Parts{FirstImages(kImages)}));
}

TEST(PartsOfOneScale, AnImageThatSeesBothHalvesTellsNothingOfTheirSizes) {
  const StreetFixture street = Street();
  const Parts parts = PartsOfOneScale(Hinging(street, 14), {});
  ASSERT_THAT(SizesOf(parts), ElementsAre(9U, 7U));
  EXPECT_THAT(parts[1], ElementsAre(0U, 1U, 2U, 3U, 4U, 5U, 6U)) << "the hinge is of the larger";
}

TEST(PartsOfOneScale, FifteenPointsOfThreeImagesTell) {
  const StreetFixture street = Street();
  EXPECT_THAT(SizesOf(PartsOfOneScale(Hinging(street, 15), {})), ElementsAre(16U));
}

TEST(PartsOfOneScale, WhatIsFarAwayTellsNothing) {
  const StreetFixture street = Street();
  EXPECT_THAT(SizesOf(PartsOfOneScale(Hinging(street, 15, true), {})), ElementsAre(9U, 7U));
}

TEST(PartsOfOneScale, TheUnitOfLengthDoesNotMatter) {
  const StreetFixture street = Street();
  for (const double factor : {1e-4, 1e4}) {
    MappingState state = Hinging(street, 14);
    Scale(state, factor);
    EXPECT_THAT(SizesOf(PartsOfOneScale(state, {})), ElementsAre(9U, 7U)) << factor;
  }
}

TEST(PartsOfOneScale, WhatWouldBeTooSmallStays) {
  const StreetFixture street = Street();
  MappingOptions options;
  options.min_component_images = 8;
  EXPECT_THAT(SizesOf(PartsOfOneScale(Hinging(street, 14), options)), ElementsAre(16U));
}

}  // namespace
}  // namespace orbweave
