// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/decode_raster.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;

TEST(DecodeRaster, BringsAPictureToTheWidthOfTheOthers) {
  const std::string encoded = Encoded(TexturedPanorama(256, 1), ".png");
  for (const int width_px : {128, 256, 512}) {
    const auto raster = DecodeRaster(encoded, "", false, {256, 128}, width_px);
    ASSERT_TRUE(raster.ok()) << raster.status();
    EXPECT_EQ(raster->camera.width_px, width_px);
    EXPECT_EQ(raster->rgb.size(), static_cast<size_t>(3 * width_px * width_px / 2));
    EXPECT_TRUE(raster->ignored.empty());
  }
}

TEST(DecodeRaster, RefusesAPictureThatWasResizedSinceItsCameraWasKnown) {
  const auto raster =
      DecodeRaster(Encoded(TexturedPanorama(128, 1), ".png"), "", false, {256, 128}, 256);
  EXPECT_EQ(raster.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(raster.status().message()), HasSubstr("128x64"));
}

TEST(DecodeRaster, RefusesWhatIsNoPictureWithASentence) {
  const auto raster = DecodeRaster("my holidays", "", false, {256, 128}, 256);
  EXPECT_EQ(raster.status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace orbweave
