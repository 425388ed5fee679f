// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/cover_nadir.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 48;

/// Columns alternate between dark and bright.
RenderedPanorama Stripes() {
  RenderedPanorama image{.camera = {kWidth, kHeight}};
  for (int k = 0; k < kWidth * kHeight; ++k) {
    const auto level = static_cast<uint8_t>(k % 2 == 0 ? 60 : 180);
    image.pixels.push_back({level, level, level});
  }
  image.ignored.assign(image.pixels.size(), 0);
  return image;
}

TEST(CoverNadir, CoversTheLowestQuarterAndSaysSo) {
  for (const NadirKind nadir : {NadirKind::kBlack, NadirKind::kBlurred}) {
    const RenderedPanorama before = Stripes();
    RenderedPanorama after = before;
    CoverNadir(after, nadir);
    for (size_t k = 0; k < after.pixels.size(); ++k) {
      const bool covered = k >= kWidth * 3 * kHeight / 4;
      EXPECT_EQ(after.ignored[k], covered ? 255 : 0);
      if (!covered) {
        ASSERT_EQ(after.pixels[k].r, before.pixels[k].r);
      } else if (nadir == NadirKind::kBlack) {
        ASSERT_EQ(after.pixels[k].r + after.pixels[k].g + after.pixels[k].b, 0);
      } else {  // a mean, at the seam as anywhere
        ASSERT_NEAR(after.pixels[k].r, 120, 8);
      }
    }
  }
}

TEST(CoverNadir, LeavesRoofAndGroundAlone) {
  for (const NadirKind nadir : {NadirKind::kRoof, NadirKind::kNone}) {
    RenderedPanorama image = Stripes();
    CoverNadir(image, nadir);
    EXPECT_EQ(image.pixels.back().r, 180);
    EXPECT_EQ(image.ignored.back(), 0);
  }
}

}  // namespace
}  // namespace orbweave
