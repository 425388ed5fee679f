// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/sphere_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr EquirectangularCamera kCamera = {2000, 1000};
constexpr double kPi = std::numbers::pi;

/// A bearing and a tangent, of all directions as `i` runs.
std::pair<Vector3d, Vector3d> Begin(int i) {
  const Eigen::Quaterniond R = RotationFromVector(Vector3d(0.7 * i, -0.31 * i, 0.13 * i));
  return {R * Vector3d::UnitZ(), R * Vector3d::UnitX()};
}

TEST(SphereCurve, AllPointsLieOnTheGreatCircle) {
  for (int i = 0; i < 12; ++i) {
    const auto [from, along] = Begin(i);
    for (const PixelCurve& curve : SphereCurve(kCamera, from, along, 2.0 * kPi)) {
      for (const Eigen::Vector2d& pixel : curve)
        EXPECT_NEAR(kCamera.BearingFromPixel(pixel).dot(from.cross(along)), 0.0, 1e-9);
    }
  }
}

TEST(SphereCurve, BeginsAndEndsWhereTheArcDoes) {
  for (int i = 0; i < 12; ++i) {
    const auto [from, along] = Begin(i);
    const auto curves = SphereCurve(kCamera, from, along, 1.0);
    EXPECT_LT(AngleBetween(kCamera.BearingFromPixel(curves.front().front()), from), 1e-9);
    const Vector3d end = std::cos(1.0) * from + std::sin(1.0) * along;
    EXPECT_LT(AngleBetween(kCamera.BearingFromPixel(curves.back().back()), end), 1e-9);
  }
}

TEST(SphereCurve, NeverJumpsAcrossThePanorama) {
  for (int i = 0; i < 12; ++i) {
    const auto [from, along] = Begin(i);
    for (const PixelCurve& curve : SphereCurve(kCamera, from, along, 2.0 * kPi)) {
      for (size_t k = 1; k < curve.size(); ++k)
        EXPECT_LE(std::abs(curve[k].x() - curve[k - 1].x()), 0.5 * kCamera.width_px);
    }
  }
}

TEST(SphereCurve, ReachesTheBorderOnBothSidesOfTheSeam) {
  // The horizon, from 20 degrees before the seam to 20 behind it.
  const Vector3d from(std::sin(160.0 * kPi / 180.0), 0.0, std::cos(160.0 * kPi / 180.0));
  const Vector3d along(from.z(), 0.0, -from.x());
  const auto curves = SphereCurve(kCamera, from, along, 40.0 * kPi / 180.0);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_GE(curves[0].back().x(), kCamera.width_px - 1e-6);
  EXPECT_LE(curves[1].front().x(), 1e-6);
}

}  // namespace
}  // namespace orbweave
