// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/report/summarise_uncertainty.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;

// Image i has a position sigma of 5 (i % 7) and i thousandths of a radian; image 3 has none.
std::map<ImageId, RegisteredImage> SomeImages(uint32_t num_images) {
  std::map<ImageId, RegisteredImage> images;
  for (uint32_t i = 0; i < num_images; ++i) {
    RegisteredImage& image = images[ImageId(i)];
    if (i == 3) continue;
    const double sigma = i % 7;
    image.uncertainty = PoseUncertainty{
        .position_covariance = Eigen::Vector3d(9.0, 16.0, 0.0).asDiagonal() * (sigma * sigma),
        .rotation_sigma_rad = 1e-3 * i};
  }
  return images;
}

TEST(SummariseUncertainty, HasMedianQuantileAndTheWorstFirst) {
  const ReportUncertainty summary = SummariseUncertainty(
      {.known = true, .held_image = "a.jpg", .bearing_sigma_factor = 1.25}, SomeImages(20), true);
  EXPECT_TRUE(summary.known);
  EXPECT_EQ(summary.held_image, "a.jpg");
  EXPECT_EQ(summary.bearing_sigma_factor, 1.25);
  EXPECT_DOUBLE_EQ(summary.position_median, 15.0);
  EXPECT_DOUBLE_EQ(summary.position_p95, 30.0);
  EXPECT_NEAR(summary.rotation_median_deg, 0.01 * 180.0 / 3.14159265358979, 1e-9);
  EXPECT_THAT(summary.worst, ElementsAre(6, 13, 5, 12, 19, 4, 11, 18, 10, 17));
}

TEST(SummariseUncertainty, SpeaksOfTheGroundWhereNoHeightIsKnown) {
  std::map<ImageId, RegisteredImage> images = SomeImages(20);
  for (auto& [id, image] : images) {
    if (image.uncertainty) image.uncertainty->position_covariance(2, 2) = 1e4 + id.value;
  }
  const ReportUncertainty summary = SummariseUncertainty({.known = true}, images, false);
  EXPECT_DOUBLE_EQ(summary.position_median, 15.0);
  EXPECT_THAT(summary.worst, ElementsAre(6, 13, 5, 12, 19, 4, 11, 18, 10, 17));
  EXPECT_GT(SummariseUncertainty({.known = true}, images, true).position_median, 100.0);
}

TEST(SummariseUncertainty, AcceptsAModelThatKnowsNothing) {
  const ReportUncertainty summary = SummariseUncertainty({.reason = "why"}, {}, true);
  EXPECT_FALSE(summary.known);
  EXPECT_EQ(summary.reason, "why");
  EXPECT_TRUE(summary.worst.empty());
}

}  // namespace
}  // namespace orbweave
