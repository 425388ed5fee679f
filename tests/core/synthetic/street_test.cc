// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/synthetic/make_street.h"
#include "core/synthetic/render_street_panorama.h"
#include "core/synthetic/rendered_panorama.h"
#include "core/synthetic/sample_surface.h"
#include "core/synthetic/street_options.h"

namespace orbweave {
namespace {

double Brightness(const Rgb& pixel) { return (pixel.r + pixel.g + pixel.b) / 3.0; }

/// Bilinear between pixel middles; columns wrap, rows are those of an inner pixel.
double BrightnessAt(const RenderedPanorama& image, const Eigen::Vector2d& position) {
  const int width = image.camera.width_px;
  const double x = position.x() - 0.5;
  const double y = position.y() - 0.5;
  const int i = static_cast<int>(std::floor(x));
  const int j = static_cast<int>(std::floor(y));
  const auto at = [&](int column, int row) {
    return Brightness(image.pixels[static_cast<size_t>(row * width + (column + width) % width)]);
  };
  return std::lerp(std::lerp(at(i, j), at(i + 1, j), x - i),
                   std::lerp(at(i, j + 1), at(i + 1, j + 1), x - i),
                   y - j);
}

/// A point of the surface that both panoramas 0 and 1 see, by its image positions in both.
using SharedPoint = std::array<Eigen::Vector2d, 2>;

std::vector<SharedPoint> SharedPoints(const Street& street, const EquirectangularCamera& camera) {
  std::vector<SharedPoint> shared;
  const Rigid3 enu_from_street{Eigen::Quaterniond::Identity(), street.street_in_enu};
  const Rigid3 cam0 = street.cams_from_enu[0] * enu_from_street;
  const Rigid3 cam1 = street.cams_from_enu[1] * enu_from_street;
  const Traffic none({});
  for (const Eigen::Vector3d& point_in_enu : SampleSurface(street, 0, 160).points_in_enu) {
    const Eigen::Vector3d point = point_in_enu - street.street_in_enu;
    const Eigen::Vector3d ray = point - cam1.Centre();
    const SurfaceHit hit = Trace(street.world, none, {cam1.Centre(), ray.normalized()});
    const SharedPoint seen = {camera.PixelFromBearing(cam0 * point),
                              camera.PixelFromBearing(cam1 * point)};
    const bool clear_of_poles = std::abs(seen[0].y() / camera.height_px - 0.5) < 0.22 &&
                                std::abs(seen[1].y() / camera.height_px - 0.5) < 0.22;
    if (clear_of_poles && std::abs(hit.distance_m - ray.norm()) < 1e-6) shared.push_back(seen);
  }
  return shared;
}

TEST(Street, TextureStaysAtItsPlaceBetweenPanoramas) {
  const StreetOptions options{
      .panoramas = 48, .width_px = 768, .spacing_m = 2.5, .exposure_spread = 0.0};
  const Street street = MakeStreet(options);
  const RenderedPanorama first = RenderStreetPanorama(street, options, 0);
  const RenderedPanorama second = RenderStreetPanorama(street, options, 1);
  const std::vector<SharedPoint> shared = SharedPoints(street, first.camera);
  ASSERT_GT(shared.size(), 2000U);
  const auto disagreement = [&](double dx, double dy) {
    double sum = 0.0;
    for (const SharedPoint& p : shared) {
      sum += std::min(20.0,
                      std::abs(BrightnessAt(first, p[0]) -
                               BrightnessAt(second, p[1] + Eigen::Vector2d(dx, dy))));
    }
    return sum / static_cast<double>(shared.size());
  };
  // The vertex of the parabola through three shifts is the best one: zero when nothing is off.
  for (const Eigen::Vector2d& axis : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)}) {
    const double minus = disagreement(-0.7 * axis.x(), -0.7 * axis.y());
    const double zero = disagreement(0.0, 0.0);
    const double plus = disagreement(0.7 * axis.x(), 0.7 * axis.y());
    EXPECT_LT(zero, std::min(minus, plus));
    EXPECT_NEAR(0.35 * (minus - plus) / (minus - 2.0 * zero + plus), 0.0, 0.1);
  }
}

TEST(Street, TheLoopClosesWithEvenSteps) {
  const StreetOptions options{.panoramas = 48};
  const Street street = MakeStreet(options);
  for (size_t i = 0; i < 48; ++i) {
    const Eigen::Vector3d here = street.cams_from_enu[i].Centre();
    const Eigen::Vector3d next = street.cams_from_enu[(i + 1) % 48].Centre();
    EXPECT_NEAR((here - next).norm(), options.spacing_m, 0.5) << i;
  }
}

TEST(Street, ShortDrivesDoNotGoRound) {
  const StreetOptions options{.panoramas = 6};
  const Street street = MakeStreet(options);
  const double end_to_end_m =
      (street.cams_from_enu[0].Centre() - street.cams_from_enu[5].Centre()).norm();
  EXPECT_GT(end_to_end_m, 5.0);
  EXPECT_LT(end_to_end_m, 6 * options.spacing_m);
}

TEST(Street, MeasurementsScatterAboutTheTruthAndHaveTheirMedianAtTheOrigin) {
  const StreetOptions options{.panoramas = 400, .gnss_sigma_m = 1.5, .gnss_bias_m = 1.0};
  const Street street = MakeStreet(options);
  std::vector<double> errors_m;
  std::array<int, 3> below{};
  for (size_t i = 0; i < 400; ++i) {
    if (!street.measured_in_enu[i]) continue;
    const Eigen::Vector3d error = *street.measured_in_enu[i] - street.cams_from_enu[i].Centre();
    errors_m.push_back(error.head<2>().norm());
    for (int axis = 0; axis < 3; ++axis)
      below[static_cast<size_t>(axis)] += (*street.measured_in_enu[i])[axis] < 0.0;
  }
  EXPECT_EQ(errors_m.size(), 400U - 32U);
  for (const int count : below) EXPECT_NEAR(count, 184, 1);
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_GT(errors_m[errors_m.size() / 2], 1.0);
  EXPECT_LT(errors_m[errors_m.size() / 2], 2.8);
  EXPECT_GT(errors_m.back(), 15.0);
}

TEST(Street, TheCameraKeepsClearOfEverythingThatStands) {
  const Street street = MakeStreet({.panoramas = 60});
  for (const Rigid3& cam : street.cams_from_enu) {
    const Eigen::Vector3d centre = cam.Centre() - street.street_in_enu;
    for (int k = 0; k < 36; ++k) {
      const double azimuth = k * 0.1745;
      const LightRay ray{centre, {std::cos(azimuth), std::sin(azimuth), 0.0}};
      EXPECT_GT(street.world.grid.Nearest(ray, 100.0).hit.distance_m, 1.5);
    }
  }
}

TEST(Street, HousesDifferBetweenSeeds) {
  const Street a = MakeStreet({.seed = 1});
  const Street b = MakeStreet({.seed = 2});
  EXPECT_NE(a.world.solids.front().half.z(), b.world.solids.front().half.z());
}

}  // namespace
}  // namespace orbweave
