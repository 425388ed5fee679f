// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/page/measure_reconstruction.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera{.width_px = 3600, .height_px = 1800};

/// One image in the origin that sees a point in direction `ray` at pixel `seen_px`.
ReconstructionMeasures Measure(const Eigen::Vector3d& ray, const Eigen::Vector2d& seen_px) {
  ImageManifest manifest;
  manifest.images.push_back({.camera = kCamera});
  const std::map<ImageId, RegisteredImage> images = {{ImageId(0), {}}};
  ReconstructionMeter meter(images, manifest);
  meter.Add(
      {.point_in_world = 4.0 * ray,
       .observations = {{.ref = {ImageId(0), 0}, .bearing = kCamera.BearingFromPixel(seen_px)}}});
  return std::move(meter).Finish();
}

TEST(ReconstructionMeter, BothResidualsAreEqualAtTheEquator) {
  const ReconstructionMeasures measures =
      Measure(kCamera.BearingFromPixel({1000.0, 900.0}), {1003.0, 900.0});
  EXPECT_NEAR(measures.residual_px_mean, 3.0, 1e-6);
  EXPECT_NEAR(measures.residual_erp_px_mean, 3.0, 1e-6);
}

TEST(ReconstructionMeter, DistancesInTheImageGrowTowardsThePoles) {
  const double row_px = 900.0 - 600.0;  // 60 degrees up: circles of latitude are half as long
  const ReconstructionMeasures measures =
      Measure(kCamera.BearingFromPixel({1000.0, row_px}), {1004.0, row_px});
  EXPECT_NEAR(measures.residual_px_mean, 2.0, 1e-3);
  EXPECT_NEAR(measures.residual_erp_px_mean, 4.0, 1e-6);
}

TEST(ReconstructionMeter, TheSeamIsNoDistance) {
  const ReconstructionMeasures measures =
      Measure(kCamera.BearingFromPixel({1.0, 900.0}), {3599.0, 904.0});
  EXPECT_NEAR(measures.residual_erp_px_mean, std::hypot(2.0, 4.0), 1e-6);
}

}  // namespace
}  // namespace orbweave
