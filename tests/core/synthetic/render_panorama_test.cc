// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/render_panorama.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/geometry/rotation.h"
#include "core/synthetic/rendered_panorama.h"

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera{256, 128};

/// The camera at a place of the street, level, its image centre turned from east by an angle.
PanoramaView ViewFrom(const Eigen::Vector3d& centre, double heading_rad) {
  Eigen::Matrix3d R;
  R << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  const Eigen::Quaterniond turn = RotationFromVector({0.0, heading_rad, 0.0});
  return {
      .camera = kCamera,
      .cam_from_street = Rigid3::FromCentre((turn * Eigen::Quaterniond(R)).normalized(), centre),
      .noise_levels = 0.0};
}

int Difference(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Mean position of the pixels above the horizon that differ (below it shadows do, too); columns
/// as angles, so that the seam is nowhere special.
Eigen::Vector2d MiddleOfChange(const RenderedPanorama& a, const RenderedPanorama& b) {
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  double rows = 0.0;
  double count = 0.0;
  for (int j = 0; j < kCamera.height_px / 2; ++j) {
    for (int i = 0; i < kCamera.width_px; ++i) {
      const auto k = static_cast<size_t>(j * kCamera.width_px + i);
      if (Difference(a.pixels[k], b.pixels[k]) < 12) continue;
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / kCamera.width_px;
      direction += Eigen::Vector2d(std::cos(angle), std::sin(angle));
      rows += j + 0.5;
      count += 1.0;
    }
  }
  const double angle = std::atan2(direction.y(), direction.x());
  double column = angle / (2.0 * std::numbers::pi) * kCamera.width_px;
  if (column < 0.0) column += kCamera.width_px;
  return {column, rows / count};
}

TEST(RenderPanorama, ShowsABallWhereItsCentreProjects) {
  StreetWorld empty = MakeStreetWorld(120.0, 1);
  empty.solids.clear();
  empty.grid = SolidGrid();
  const Traffic none({});
  for (const double heading : {0.3, 1.9, std::numbers::pi, 4.0}) {  // pi: on the seam
    const PanoramaView view = ViewFrom({1.0, -2.0, 0.3}, heading);
    const Solid ball{.kind = SolidKind::kCrown,
                     .centre = view.cam_from_street.Centre() + Eigen::Vector3d(6.0, 0.0, 2.4),
                     .half = Eigen::Vector3d::Constant(0.9)};
    StreetWorld world = empty;
    world.solids = {ball};
    world.grid = SolidGrid(world.solids);
    const Eigen::Vector2d seen =
        MiddleOfChange(RenderPanorama(empty, none, view), RenderPanorama(world, none, view));
    const Eigen::Vector2d expected = kCamera.PixelFromBearing(view.cam_from_street * ball.centre);
    const double across = std::remainder(seen.x() - expected.x(), kCamera.width_px);
    EXPECT_NEAR(across, 0.0, 0.25) << heading;
    EXPECT_NEAR(seen.y(), expected.y(), 0.35) << heading;
  }
}

/// Where a ball appears of which `view` makes one panorama with and one without.
Eigen::Vector2d WhereTheBallAppears(const PanoramaView& view, const Eigen::Vector3d& centre) {
  StreetWorld world = MakeStreetWorld(120.0, 1);
  const Traffic none({});
  world.solids.clear();
  world.grid = SolidGrid();
  const RenderedPanorama without = RenderPanorama(world, none, view);
  world.solids = {
      {.kind = SolidKind::kCrown, .centre = centre, .half = Eigen::Vector3d::Constant(0.8)}};
  world.grid = SolidGrid(world.solids);
  return MiddleOfChange(without, RenderPanorama(world, none, view));
}

TEST(RenderPanorama, RollingShutterShowsABallFromWhereItsRowWasExposed) {
  PanoramaView view = ViewFrom({1.0, -2.0, 0.3}, 0.3);
  view.shutter = {.readout_s = 0.2, .velocity_mps = {-14.0, 5.0, 0.0}, .yaw_rate_rad_s = 0.6};
  const Eigen::Vector3d ball = view.cam_from_street.Centre() + Eigen::Vector3d(4.0, 1.0, 3.0);
  const Eigen::Vector2d seen = WhereTheBallAppears(view, ball);
  const auto project_at = [&](double late_s) {
    const Eigen::Quaterniond turn =
        RotationFromVector({0.0, 0.0, view.shutter.yaw_rate_rad_s * late_s});
    const Rigid3 pose =
        Rigid3::FromCentre(view.cam_from_street.rotation * turn.conjugate(),
                           view.cam_from_street.Centre() + late_s * view.shutter.velocity_mps);
    return kCamera.PixelFromBearing(pose * ball);
  };
  Eigen::Vector2d expected = project_at(0.0);
  const Eigen::Vector2d still = expected;
  for (int k = 0; k < 20; ++k)
    expected = project_at((expected.y() / kCamera.height_px - 0.5) * view.shutter.readout_s);
  EXPECT_GT((expected - still).norm(), 3.0);
  EXPECT_NEAR(std::remainder(seen.x() - expected.x(), kCamera.width_px), 0.0, 0.5);
  EXPECT_NEAR(seen.y(), expected.y(), 0.5);
}

TEST(RenderPanorama, LensesShowABallWithTheirParallax) {
  PanoramaView view = ViewFrom({1.0, -2.0, 0.3}, 0.3);
  view.lenses.offset_m = 0.5;
  const Eigen::Vector3d in_cam = Eigen::Vector3d(1.2, -2.0, 3.5);  // seen by the forward lens
  const Eigen::Vector3d ball = view.cam_from_street.Inverse() * in_cam;
  const Eigen::Vector2d seen = WhereTheBallAppears(view, ball);
  // The ray from the lens through the ball meets the sphere on which the pictures are stitched.
  const Eigen::Vector3d lens(0.0, 0.0, 0.5);
  const Eigen::Vector3d d = (in_cam - lens).normalized();
  const double b = lens.dot(d);
  const double reach =
      -b + std::sqrt(b * b + std::pow(LensRig::kStitchedAt_m, 2) - lens.squaredNorm());
  const Eigen::Vector2d expected = kCamera.PixelFromBearing(lens + reach * d);
  EXPECT_GT((expected - kCamera.PixelFromBearing(in_cam)).norm(), 1.0);
  EXPECT_NEAR(seen.x(), expected.x(), 0.5);
  EXPECT_NEAR(seen.y(), expected.y(), 0.5);
}

TEST(RenderPanorama, TurningTheCameraByWholePixelsShiftsColumns) {
  const StreetWorld world = MakeStreetWorld(120.0, 1);
  const Traffic none({});
  constexpr int kShift = 37;
  const Eigen::Vector3d centre(0.0, world.layout.half_m.y(), 0.0);
  const RenderedPanorama plain = RenderPanorama(world, none, ViewFrom(centre, 0.4));
  const RenderedPanorama turned = RenderPanorama(
      world, none, ViewFrom(centre, 0.4 + 2.0 * std::numbers::pi * kShift / kCamera.width_px));
  size_t different = 0;
  for (int j = 0; j < kCamera.height_px / 2; ++j) {  // below is the carrier, which turns along
    for (int i = 0; i < kCamera.width_px; ++i) {
      const int there = (i + kShift) % kCamera.width_px;
      const auto row = static_cast<size_t>(j * kCamera.width_px);
      different += Difference(plain.pixels[row + static_cast<size_t>(i)],
                              turned.pixels[row + static_cast<size_t>(there)]) > 1;
    }
  }
  EXPECT_LT(different, 20U);  // pixels on an edge may fall to either side
}

TEST(RenderPanorama, IgnoresTheRoofBelowAndMovingCarsOnRequest) {
  const StreetWorld world = MakeStreetWorld(120.0, 1);
  const Eigen::Vector3d centre(0.0, world.layout.half_m.y(), 0.0);
  PanoramaView view = ViewFrom(centre, 0.0);
  const Solid car{.kind = SolidKind::kCarBody,
                  .centre = centre + Eigen::Vector3d(6.0, 0.0, -1.5),
                  .half = {2.0, 0.9, 0.8}};
  const Traffic traffic({car});
  const auto count = [](const RenderedPanorama& image, int first_row, int last_row) {
    int n = 0;
    for (int k = first_row * kCamera.width_px; k < last_row * kCamera.width_px; ++k)
      n += image.ignored[static_cast<size_t>(k)] != 0;
    return n;
  };
  const int h = kCamera.height_px;
  const RenderedPanorama masked = RenderPanorama(world, traffic, view);
  EXPECT_EQ(count(masked, h - 8, h), 8 * kCamera.width_px);
  EXPECT_GT(count(masked, h / 2, 3 * h / 4), 10);
  EXPECT_EQ(count(masked, 0, h / 2 - 4), 0);
  view.mask_traffic = false;
  EXPECT_LT(count(RenderPanorama(world, traffic, view), h / 2, 3 * h / 4),
            count(masked, h / 2, 3 * h / 4));
}

}  // namespace
}  // namespace orbweave
