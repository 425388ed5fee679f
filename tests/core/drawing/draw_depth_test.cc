// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/dense/equiangular_raster.h"
#include "core/drawing/color_scale.h"
#include "core/drawing/draw_depth_map.h"
#include "core/drawing/draw_top_view.h"

namespace orbweave {
namespace {

cv::Mat Decoded(const absl::StatusOr<std::string>& bytes, int flags) {
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  if (!bytes.ok()) return {};
  return cv::imdecode(std::vector<uchar>(bytes->begin(), bytes->end()), flags);
}

/// Near ahead, far behind, nothing above.
DepthMap MadeUpMap() {
  DepthMap map{.face_px = 32};
  const EquiangularRaster raster{map.face_px};
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < map.face_px; ++row) {
      for (int column = 0; column < map.face_px; ++column) {
        const Eigen::Vector3d bearing = raster.BearingFromPixel(face, row + 0.5, column + 0.5);
        const float range = bearing.z() > 0.0 ? 2.0F : 20.0F;
        map.range_m.push_back(bearing.y() < -0.5 ? 0.0F : range);
      }
    }
  }
  return map;
}

double Distance(const cv::Vec3b& bgr, const Rgb& color) {
  return cv::norm(cv::Vec3d(bgr) - cv::Vec3d(color.b, color.g, color.r));
}

TEST(DrawDepthMap, ColorsDistancesWhereThePanoramaSeesThem) {
  const PictureImage image{.name = "a", .camera = {512, 256}};
  const cv::Mat picture = Decoded(DrawDepthMap(image, MadeUpMap(), "m"), cv::IMREAD_COLOR);
  ASSERT_EQ(picture.cols, picture.rows);
  const int middle = picture.rows * 3 / 4;
  EXPECT_LT(Distance(picture.at<cv::Vec3b>(middle, picture.cols / 2), ColorOnScale(0.0)), 30.0);
  EXPECT_LT(Distance(picture.at<cv::Vec3b>(middle, 20), ColorOnScale(1.0)), 30.0);
  const cv::Vec3b sky = picture.at<cv::Vec3b>(picture.rows / 2 + 20, picture.cols / 2);
  EXPECT_LT(cv::norm(sky), 80.0);
}

TEST(DrawDepthMap, DrawsAMapWithoutAnyDistance) {
  const PictureImage image{.name = "a", .camera = {512, 256}};
  EXPECT_FALSE(Decoded(DrawDepthMap(image, DepthMap{}, "m"), cv::IMREAD_COLOR).empty());
}

TEST(DrawTopView, IsTransparentWhereNothingIsSeen) {
  const TopPicture picture{
      .width_px = 2, .height_px = 1, .rgba = {10, 20, 30, 255, 0, 0, 0, 0}, .pixel = 1.0};
  const cv::Mat decoded = Decoded(DrawTopView(picture), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(decoded.channels(), 4);
  EXPECT_EQ(decoded.at<cv::Vec4b>(0, 0), cv::Vec4b(30, 20, 10, 255));
  EXPECT_EQ(decoded.at<cv::Vec4b>(0, 1)[3], 0);
}

}  // namespace
}  // namespace orbweave
