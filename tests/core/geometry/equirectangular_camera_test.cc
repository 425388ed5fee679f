// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/equirectangular_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr EquirectangularCamera kCamera = {5376, 2688};

TEST(EquirectangularCamera, HasItsAxesWhereEquationsOneToThreePutThem) {
  EXPECT_LT((kCamera.PixelFromBearing(Vector3d::UnitZ()) - Vector2d(2688, 1344)).norm(), 1e-9);
  EXPECT_LT((kCamera.PixelFromBearing(Vector3d::UnitX()) - Vector2d(4032, 1344)).norm(), 1e-9);
  EXPECT_LT((kCamera.PixelFromBearing(-Vector3d::UnitX()) - Vector2d(1344, 1344)).norm(), 1e-9);
  EXPECT_NEAR(kCamera.PixelFromBearing(Vector3d::UnitY()).y(), 2688.0, 1e-9);
  EXPECT_NEAR(kCamera.PixelFromBearing(-Vector3d::UnitY()).y(), 0.0, 1e-9);
}

TEST(EquirectangularCamera, ComesBackFromPixelsAndBearings) {
  Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Vector3d bearing = testing::RandomDirection(random);
    const Vector2d pixel = kCamera.PixelFromBearing(bearing);
    EXPECT_LT(AngleBetween(kCamera.BearingFromPixel(pixel), bearing), 1e-12);
    EXPECT_LT((kCamera.PixelFromBearing(3.0 * bearing) - pixel).norm(), 1e-9);  // any length
  }
}

TEST(EquirectangularCamera, IsContinuousAcrossTheSeam) {
  const Vector3d left = kCamera.BearingFromPixel({1e-6, 700.0});
  const Vector3d right = kCamera.BearingFromPixel({5376.0 - 1e-6, 700.0});
  EXPECT_LT(AngleBetween(left, right), 1e-8);
  const Vector2d pixel = kCamera.PixelFromBearing(Vector3d(0.0, 0.0, -1.0));
  EXPECT_GE(pixel.x(), 0.0);
  EXPECT_LT(pixel.x(), 5376.0);
}

TEST(EquirectangularCamera, KeepsItsDigitsAtThePoles) {
  for (const double offset_rad : {1e-3, 1e-6, 1e-9}) {
    const Vector3d bearing(std::sin(offset_rad), std::cos(offset_rad), 0.0);
    const double row = kCamera.PixelFromBearing(bearing).y();
    EXPECT_NEAR((2688.0 - row) / 2688.0 * pi, offset_rad, 1e-14);
  }
}

TEST(EquirectangularCamera, TurnsPixelsAtTheEquatorIntoAngles) {
  EXPECT_NEAR(kCamera.AngleFromPixels(4.0), 2.0 * pi / 5376.0 * 4.0, 1e-15);
  EXPECT_NEAR(kCamera.PixelsFromAngle(kCamera.AngleFromPixels(7.5)), 7.5, 1e-12);
  const Vector3d a = kCamera.BearingFromPixel({100.0, 1344.0});
  const Vector3d b = kCamera.BearingFromPixel({101.0, 1344.0});
  EXPECT_NEAR(AngleBetween(a, b), kCamera.AngleFromPixels(1.0), 1e-12);
}

}  // namespace
}  // namespace orbweave
