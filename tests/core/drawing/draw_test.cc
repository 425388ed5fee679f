// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/drawing/color_scale.h"
#include "core/drawing/draw_image.h"
#include "core/drawing/draw_pair.h"
#include "tests/core/pictures/encoded_images.h"

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera = {512, 256};

cv::Mat Decoded(const absl::StatusOr<std::string>& png) {
  EXPECT_TRUE(png.ok()) << png.status();
  if (!png.ok()) return {};
  return cv::imdecode(std::vector<uchar>(png->begin(), png->end()), cv::IMREAD_COLOR);
}

/// A panorama of one colour.
std::string PlainImage(const cv::Scalar& bgr) {
  return Encoded(cv::Mat(256, 512, CV_8UC3, bgr), ".png");
}

/// How many pixels of the picture have nearly this colour.
int CountColor(const cv::Mat& picture, const Rgb& color) {
  const cv::Scalar tolerance = cv::Scalar::all(12);
  const cv::Scalar wanted(color.b, color.g, color.r);
  cv::Mat mask;
  cv::inRange(picture, wanted - tolerance, wanted + tolerance, mask);
  return cv::countNonZero(mask);
}

PairPicture PicturedPair() {
  PairPicture picture{.a = {"a", PlainImage({200, 0, 0}), kCamera},
                      .b = {"b", PlainImage({0, 0, 200}), kCamera},
                      .headlines = {"title", "text"}};
  for (int i = 0; i < 8; ++i) {
    picture.inliers.push_back({{60.0 * i + 10.0, 100.0}, {60.0 * i + 14.0, 140.0}, 0.1});
  }
  return picture;
}

TEST(DrawPair, LaysThePanoramasBelowEachOther) {
  const cv::Mat picture = Decoded(DrawPair(PicturedPair()));
  ASSERT_EQ(picture.cols, 2048);
  const int first_blue = 500;
  const cv::Vec3b above = picture.at<cv::Vec3b>(first_blue, 1000);
  const cv::Vec3b below = picture.at<cv::Vec3b>(picture.rows - 500, 1000);
  EXPECT_GT(above[0], above[2] + 50);  // blue, green, red
  EXPECT_GT(below[2], below[0] + 50);
}

TEST(DrawPair, SamePictureSameBytes) {
  EXPECT_EQ(*DrawPair(PicturedPair()), *DrawPair(PicturedPair()));
}

TEST(DrawPair, PanoramasWithoutPixelsAreDrawnOnADarkGround) {
  PairPicture picture = PicturedPair();
  picture.a.encoded.clear();
  picture.b.encoded = "no image at all";
  const cv::Mat drawn = Decoded(DrawPair(picture));
  EXPECT_EQ(drawn.rows, Decoded(DrawPair(PicturedPair())).rows);
  EXPECT_GT(CountColor(drawn, {22, 24, 28}), drawn.rows * drawn.cols / 2);
}

TEST(DrawPair, EpipolarCurvesPassThroughTheirFeatures) {
  // b one unit to the right of a; points at depth 3 ahead and to the sides.
  PairPicture picture{.a = {"a", "", kCamera}, .b = {"b", "", kCamera}};
  picture.b_from_a = Eigen::Quaterniond::Identity();
  picture.baseline_in_a = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d point(0.3, -0.4, 3.0);
  const Eigen::Vector2d at_a = kCamera.PixelFromBearing(point);
  const Eigen::Vector2d at_b = kCamera.PixelFromBearing(point - Eigen::Vector3d::UnitX());
  picture.inliers.push_back({at_a, at_b, 0.3});
  const cv::Mat drawn = Decoded(DrawPair(picture));
  // Inside of the ring, left and right of the dot, the curve goes on in the ring's colour.
  const Rgb color = ColorOfNumber(0);
  const double scale = 2048.0 / kCamera.width_px;
  const cv::Rect ring(cvRound(at_a.x() * scale) - 6, cvRound(at_a.y() * scale) - 6, 12, 12);
  EXPECT_GE(CountColor(drawn(ring), color), 8);
  EXPECT_GT(CountColor(drawn, color), 1000);
}

TEST(DrawPair, WithoutAGeometryThereAreNoCurves) {
  PairPicture picture{.a = {"a", "", kCamera}, .b = {"b", "", kCamera}, .is_verified = false};
  picture.outliers.push_back({{100.0, 100.0}, {120.0, 110.0}, 0.0});
  const cv::Mat drawn = Decoded(DrawPair(picture));
  EXPECT_EQ(CountColor(drawn, ColorOfNumber(0)), 0);
}

TEST(DrawPair, FeaturesAtPolesSeamAndEpipolesDoNoHarm) {
  PairPicture picture = PicturedPair();
  picture.b_from_a = Eigen::Quaterniond::Identity();
  picture.baseline_in_a = Eigen::Vector3d::UnitY();
  picture.inliers = {{{0.0, 0.0}, {511.9, 256.0}, 0.0},
                     {{511.99, 128.0}, {0.0, 128.0}, 3.1},
                     {{256.0, 256.0}, {256.0, 0.0}, 0.0}};
  EXPECT_TRUE(DrawPair(picture).ok());
}

TEST(DrawImage, ColoursFeaturesByTheLengthOfTheirTracks) {
  ImagePicture picture{.image = {"a", "", kCamera}, .headlines = {"title"}};
  for (int i = 0; i < 20; ++i) picture.tracked.push_back({{20.0 * i + 10.0, 128.0}, 12, 0.0});
  const int all_long = CountColor(Decoded(DrawImage(picture)), ColorOnScale(1.0));
  for (PictureFeature& feature : picture.tracked) feature.track_length = 2;
  EXPECT_GT(all_long, CountColor(Decoded(DrawImage(picture)), ColorOnScale(1.0)) + 200);
}

TEST(DrawImage, ColoursFeaturesByResidualWhenAsked) {
  ImagePicture picture{.image = {"a", "", kCamera}, .colors = FeatureColors::kResidual};
  for (int i = 0; i < 20; ++i) picture.tracked.push_back({{20.0 * i + 10.0, 128.0}, 2, 9.0});
  const int all_bad = CountColor(Decoded(DrawImage(picture)), ColorOnScale(1.0));
  for (PictureFeature& feature : picture.tracked) feature.residual_px = 0.1;
  EXPECT_GT(all_bad, CountColor(Decoded(DrawImage(picture)), ColorOnScale(1.0)) + 200);
}

TEST(DrawImage, LabelsThatMeetMoveApartAndStayOnThePicture) {
  ImagePicture picture{.image = {"a", "", kCamera}};
  for (int i = 0; i < 60; ++i)
    picture.directions.push_back({Eigen::Vector3d(1e-3 * i, 0.9, 0.1).normalized(), "a long name"});
  EXPECT_TRUE(DrawImage(picture).ok());
}

}  // namespace
}  // namespace orbweave
