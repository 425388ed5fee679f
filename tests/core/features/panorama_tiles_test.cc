// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/panorama_tiles.h"

#include <gtest/gtest.h>

#include "tests/core/features/panorama_images.h"

namespace orbweave {
namespace {

TEST(PlanTiles, CoversEveryPixelOnceAndKeepsTheMargin) {
  for (const cv::Size size :
       {cv::Size(512, 256), cv::Size(1001, 500), cv::Size(64, 32), cv::Size(2, 1)}) {
    cv::Mat covered(size, CV_8UC1, cv::Scalar(0));
    for (const Tile& tile : PlanTiles(size, 0, size.height, 100, 40)) {
      covered(tile.core) += 1;
      EXPECT_EQ(tile.core.x % kTileAlignment, 0);
      EXPECT_EQ(tile.core.y % kTileAlignment, 0);
      EXPECT_EQ(tile.padded.width % kTileAlignment, 0);
      EXPECT_EQ(tile.padded.height % kTileAlignment, 0);
      const cv::Rect with_margin(
          tile.core.x - 40, tile.core.y - 40, tile.core.width + 80, tile.core.height + 80);
      EXPECT_EQ(tile.padded & with_margin, with_margin);
    }
    EXPECT_EQ(cv::countNonZero(covered == 1), size.area());
  }
}

TEST(CutTile, ContinuesAcrossTheSeam) {
  const cv::Mat panorama = TexturedPanorama(128, 1);
  const cv::Mat rolled = Rolled(panorama, 30);
  EXPECT_EQ(cv::norm(CutTile(panorama, {-30, 5, 128, 40}), rolled.rowRange(5, 45), cv::NORM_INF),
            0.0);
  EXPECT_EQ(cv::norm(CutTile(panorama, {98, 5, 128, 40}), rolled.rowRange(5, 45), cv::NORM_INF),
            0.0);
}

TEST(CutTile, ContinuesAcrossThePolesHalfATurnFurther) {
  const cv::Mat panorama = TexturedPanorama(128, 2);
  const cv::Mat tile = CutTile(panorama, {0, -2, 128, 68});
  for (int x = 0; x < 128; ++x) {
    const int opposite = (x + 64) % 128;
    EXPECT_EQ(tile.at<cv::Vec3b>(1, x), panorama.at<cv::Vec3b>(0, opposite));
    EXPECT_EQ(tile.at<cv::Vec3b>(0, x), panorama.at<cv::Vec3b>(1, opposite));
    EXPECT_EQ(tile.at<cv::Vec3b>(2, x), panorama.at<cv::Vec3b>(0, x));
    EXPECT_EQ(tile.at<cv::Vec3b>(66, x), panorama.at<cv::Vec3b>(63, opposite));
  }
}

TEST(CutTile, MayBeLargerThanThePanorama) {
  const cv::Mat panorama = TexturedPanorama(32, 3);
  const cv::Mat tile = CutTile(panorama, {-80, -40, 176, 96});
  EXPECT_EQ(tile.at<cv::Vec3b>(40 + 3, 80 + 5 + 64), panorama.at<cv::Vec3b>(3, 5));
}

}  // namespace
}  // namespace orbweave
