// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/draw_carrier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/sphere_cells.h"
#include "core/scene/carrier.h"

namespace orbweave {
namespace {

cv::Mat MaskOf(const std::vector<uint32_t>& cells) {
  const absl::StatusOr<std::string> bytes = DrawCarrier(cells);
  EXPECT_TRUE(bytes.ok()) << bytes.status();
  return cv::imdecode(std::vector<uchar>(bytes->begin(), bytes->end()), cv::IMREAD_UNCHANGED);
}

double WhiteShareOfSphere(const cv::Mat& mask) {
  double share = 0.0;
  for (int row = 0; row < mask.rows; ++row) {
    const double latitude = ((row + 0.5) / mask.rows - 0.5) * std::numbers::pi;
    share += cv::countNonZero(mask.row(row)) * std::cos(latitude);
  }
  return share * std::numbers::pi / (2.0 * mask.rows * mask.cols);
}

TEST(DrawCarrier, IsWhiteWhereTheCarrierShows) {
  const std::vector<Eigen::Vector3d> shown = {Eigen::Vector3d(0.1, 0.9, 0.2).normalized(),
                                              Eigen::Vector3d(-0.01, 0.01, -1.0).normalized()};
  std::vector<uint32_t> cells;
  for (const Eigen::Vector3d& bearing : shown) cells.push_back(SphereCell(bearing, kCarrierCells));
  std::ranges::sort(cells);
  const cv::Mat mask = MaskOf(cells);
  ASSERT_EQ(mask.type(), CV_8UC1);
  ASSERT_EQ(mask.cols, 2 * mask.rows);
  const EquirectangularCamera camera{mask.cols, mask.rows};
  for (const Eigen::Vector3d& bearing : shown) {
    const Eigen::Vector2d pixel = camera.PixelFromBearing(bearing);
    EXPECT_EQ(mask.at<uint8_t>(static_cast<int>(pixel.y()), static_cast<int>(pixel.x())), 255);
  }
  EXPECT_NEAR(WhiteShareOfSphere(mask) * kNumCarrierCells, 2.0, 0.3) << "and nowhere else";
}

TEST(DrawCarrier, IsBlackWithoutACarrier) { EXPECT_EQ(cv::countNonZero(MaskOf({})), 0); }

}  // namespace
}  // namespace orbweave
