// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/stages/summarise_uncertainty.h"

#include <gmock/gmock.h>

namespace orbweave {
namespace {

using ::testing::ElementsAre;

// Image i has a position sigma of 5 (i % 7) and i thousandths of a radian; image 3 has none.
GloballyAdjusted SomeWorld(uint32_t num_images) {
  GloballyAdjusted world;
  for (uint32_t i = 0; i < num_images; ++i) {
    RegisteredImage& image = world.reconstruction.images[ImageId(i)];
    if (i == 3) continue;
    const double sigma = i % 7;
    image.uncertainty = PoseUncertainty{
        .position_covariance = Eigen::Vector3d(9.0, 16.0, 0.0).asDiagonal() * (sigma * sigma),
        .rotation_sigma_rad = 1e-3 * i};
  }
  return world;
}

TEST(SummariseUncertainty, HasMedianQuantileAndTheWorstFirst) {
  GloballyAdjusted world = SomeWorld(20);
  world.report.uncertainty = {.known = true, .held_image = "a.jpg", .bearing_sigma_factor = 1.25};
  const ReportUncertainty summary = SummariseUncertainty(world);
  EXPECT_TRUE(summary.known);
  EXPECT_EQ(summary.held_image, "a.jpg");
  EXPECT_EQ(summary.bearing_sigma_factor, 1.25);
  EXPECT_DOUBLE_EQ(summary.position_median, 15.0);
  EXPECT_DOUBLE_EQ(summary.position_p95, 30.0);
  EXPECT_NEAR(summary.rotation_median_deg, 0.01 * 180.0 / 3.14159265358979, 1e-9);
  EXPECT_THAT(summary.worst, ElementsAre(6, 13, 5, 12, 19, 4, 11, 18, 10, 17));
}

TEST(SummariseUncertainty, AcceptsAWorldThatKnowsNothing) {
  GloballyAdjusted world;
  world.report.uncertainty.reason = "why";
  const ReportUncertainty summary = SummariseUncertainty(world);
  EXPECT_FALSE(summary.known);
  EXPECT_EQ(summary.reason, "why");
  EXPECT_TRUE(summary.worst.empty());
}

}  // namespace
}  // namespace orbweave
