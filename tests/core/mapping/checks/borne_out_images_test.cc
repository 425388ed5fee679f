// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/borne_out_images.h"

#include <gtest/gtest.h>

#include "tests/core/mapping/gnss_walk.h"

namespace orbweave {
namespace {

constexpr ImageSlot kNone = GnssWalk::kImages;

TEST(BorneOutImages, CountsAllOfARightModel) {
  EXPECT_GE(BorneOutImages(GnssWalk().StateWithout(kNone)), 13.0);
}

TEST(BorneOutImages, PrefersASmallerModelToOneThatLostTheScale) {
  const GnssWalk walk;
  MappingState large = walk.StateWithout(kNone);
  for (ImageSlot image = 8; image < GnssWalk::kImages; ++image)
    large.SetPose(image, walk.Further(image, -7.0 * (image - 7.0)));
  EXPECT_LT(BorneOutImages(large), BorneOutImages(walk.StateWithout(3)) - 2.0);
}

TEST(BorneOutImages, CountsImagesWithoutPositions) {
  GnssWalk walk;
  for (uint32_t image = 0; image < GnssWalk::kImages; ++image)
    walk.Prior(image).position_in_enu.reset();
  EXPECT_EQ(BorneOutImages(walk.StateWithout(2)), 13.0);
}

}  // namespace
}  // namespace orbweave
