// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/facade_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace orbweave {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kFocal_px = 326.0;

Vector2d RandomPixel(Random& random, const FacadeView& view) {
  return {random.Uniform(0.0, view.Width()), random.Uniform(0.0, view.Height())};
}

TEST(FacadeView, LooksLevelInItsDirection) {
  for (int number = 0; number < kNumFacadeViews; ++number) {
    const FacadeView view{number, kFocal_px};
    const double azimuth = number * std::numbers::pi / 4.0;
    const Vector3d middle = view.BearingFromPixel({0.5 * view.Width(), kFocal_px});
    EXPECT_LT((middle - Vector3d(std::sin(azimuth), 0.0, std::cos(azimuth))).norm(), 2e-3)
        << number;
    EXPECT_LT(view.BearingFromPixel({0.5 * view.Width(), 0.0}).y(), -0.7);  // up
  }
}

/// A wall that stands parallel to the image plane is the same picture from everywhere along it.
TEST(FacadeView, OnlyShiftsAWallWhenTheCameraMovesAlongIt) {
  Random random(1);
  const FacadeView view{0, kFocal_px};
  const double depth = 8.0;
  const double step = 12.0;
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2d pixel = RandomPixel(random, view);
    const Vector3d bearing = view.BearingFromPixel(pixel);
    const Vector3d on_wall = bearing * (depth / bearing.z());
    const Vector3d from_next = (on_wall - Vector3d(step, 0.0, 0.0)).normalized();
    const Vector2d shifted = pixel - Vector2d(kFocal_px * step / depth, 0.0);
    EXPECT_LT((view.BearingFromPixel(shifted) - from_next).norm(), 1e-12);
  }
}

TEST(FacadeView, ScalesByTheRootOfTheSolidAngleOfAPixel) {
  Random random(2);
  const FacadeView view{3, kFocal_px};
  const auto solid_angle = [&](const Vector2d& pixel) {
    constexpr double kStep = 1e-3;
    const Vector3d dx = view.BearingFromPixel(pixel + Vector2d(kStep, 0.0)) -
                        view.BearingFromPixel(pixel - Vector2d(kStep, 0.0));
    const Vector3d dy = view.BearingFromPixel(pixel + Vector2d(0.0, kStep)) -
                        view.BearingFromPixel(pixel - Vector2d(0.0, kStep));
    return dx.cross(dy).norm() / (4.0 * kStep * kStep);
  };
  for (int trial = 0; trial < 100; ++trial) {
    const Vector2d pixel = RandomPixel(random, view);
    EXPECT_NEAR(
        view.ScaleAt(pixel), kFocal_px * std::sqrt(solid_angle(pixel)), 1e-5 * view.ScaleAt(pixel));
  }
}

TEST(FacadeView, NeighboursOverlapAllAround) {
  const FacadeView view{0, kFocal_px};
  const Vector3d left = view.BearingFromPixel({0.0, kFocal_px});
  const Vector3d right = view.BearingFromPixel({static_cast<double>(view.Width()), kFocal_px});
  EXPECT_NEAR(std::atan2(right.x(), right.z()), std::numbers::pi / 3.0, 2e-3);
  EXPECT_NEAR(std::atan2(left.x(), left.z()), -std::numbers::pi / 3.0, 2e-3);
}

}  // namespace
}  // namespace orbweave
