// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adjust_local.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(CovisibleWindow, HoldsTheImageAndItsNearestNeighbours) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  const MappingState state = street.TriangulatedStateWith(FirstImages(12));
  const std::vector<ImageSlot> window = CovisibleWindow(state, 6, 5);
  ASSERT_EQ(window.size(), 5U);
  EXPECT_EQ(window.front(), 6U);
  for (const ImageSlot image : window) {
    EXPECT_GE(image, 3U);
    EXPECT_LE(image, 9U);
  }
}

TEST(AdjustLocally, DoesNotTouchImagesOutsideTheWindow) {
  const StreetFixture street({.centres = StraightWalk(12, 3.0)});
  MappingState state = street.TriangulatedStateWith(FirstImages(12));
  MappingOptions options;
  options.local_window = 4;
  const std::vector<ImageSlot> window = CovisibleWindow(state, 11, 4);
  ASSERT_TRUE(AdjustLocally(state, 11, options, {}).ok());
  for (ImageSlot image = 0; image < 12; ++image) {
    const bool moved = state.Centre(image) != street.world.cams_from_world[image].Centre();
    EXPECT_EQ(moved, std::ranges::count(window, image) > 0) << image;
  }
}

}  // namespace
}  // namespace orbweave
