// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/equiangular_raster.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/cube_face.h"
#include "core/geometry/equirectangular_camera.h"
#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

constexpr EquiangularRaster kRaster = {512};

TEST(EquiangularRaster, ComesBackFromPixelsAndBearings) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Vector3d bearing = testing::RandomDirection(random);
    const EquiangularRaster::Place place = kRaster.PixelFromBearing(bearing);
    EXPECT_EQ(place.face, FaceOf(bearing));
    EXPECT_GE(std::min(place.row, place.column), -1e-9);
    EXPECT_LE(std::max(place.row, place.column), 512.0 + 1e-9);
    const Eigen::Vector3d back = kRaster.BearingFromPixel(place.face, place.row, place.column);
    EXPECT_LT(AngleBetween(back, bearing), 1e-12);
    EXPECT_LT(kRaster.Index(place), kRaster.NumPixels());
  }
}

TEST(EquiangularRaster, HasPixelsOfEqualAnglesAlongItsAxes) {
  for (const double column : {10.0, 200.0, 500.0}) {
    const Eigen::Vector3d a = kRaster.BearingFromPixel(1, 256.0, column);
    const Eigen::Vector3d b = kRaster.BearingFromPixel(1, 256.0, column + 1.0);
    EXPECT_NEAR(AngleBetween(a, b), kRaster.PixelAngle(), 1e-12);
  }
}

TEST(EquiangularRaster, LosesNothingAtTheEquatorOfAPanoramaFourTimesAsWide) {
  const EquirectangularCamera camera{2048, 1024};
  EXPECT_NEAR(kRaster.PixelAngle(), camera.AngleFromPixels(1.0), 1e-15);
  EXPECT_NEAR(static_cast<double>(kRaster.NumPixels()), 0.75 * 2048 * 1024, 1.0);
}

TEST(EquiangularRaster, RunsOnBeyondTheEdgeOntoTheNextFace) {
  const Eigen::Vector3d beyond = kRaster.BearingFromPixel(0, 256.0, 515.0);
  const EquiangularRaster::Place place = kRaster.PixelFromBearing(beyond);
  EXPECT_EQ(place.face, 1);
  EXPECT_NEAR(place.column, 3.0, 1e-9);
  EXPECT_NEAR(place.row, 256.0, 1e-9);
}

}  // namespace
}  // namespace orbweave
