// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/raster_bearings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

TEST(RasterBearings, HasTheBearingsOfItsRaster) {
  const RasterBearings bearings({17});
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < 17; ++row) {
      for (int column = 0; column < 17; ++column) {
        const Vector3d bearing = bearings.raster().BearingFromPixel(face, row + 0.5, column + 0.5);
        const size_t index = bearings.raster().Index(face, row, column);
        EXPECT_LT((bearings.Of(index) - bearing).norm(), 1e-15);
      }
    }
  }
}

TEST(RasterBearings, FindsAllPixelsAroundABearingOnAnyFace) {
  const RasterBearings bearings({12});
  const EquiangularRaster& raster = bearings.raster();
  Random random(1);
  std::vector<size_t> found;
  size_t total = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    Vector3d bearing = testing::RandomDirection(random);
    if (trial % 2 == 0) {  // near edges and corners of faces
      bearing = bearing.cwiseSign() + 0.1 * testing::RandomDirection(random);
      if (trial % 4 == 0) bearing[trial / 4 % 3] = random.Uniform(-1.0, 1.0);
      bearing.normalize();
    }
    for (const double limit_px : {0.5, 0.8, 1.0}) {
      std::vector<size_t> expected;
      for (size_t i = 0; i < raster.NumPixels(); ++i) {
        const double chord = (bearings.Of(i) - bearing).norm();
        if (chord <= limit_px * raster.PixelAngle()) expected.push_back(i);
      }
      bearings.Around(bearing, limit_px, found);
      std::ranges::sort(found);
      EXPECT_EQ(found, expected) << bearing.transpose();
      total += found.size();
    }
  }
  EXPECT_GT(total, 12000U);
}

}  // namespace
}  // namespace orbweave
