// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/lens_rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/geometry/rotation.h"
#include "core/synthetic/camera_rays.h"

namespace orbweave {
namespace {

TEST(LensRig, EachBearingBelongsToALensWithin55DegreesButStraightDown) {
  for (double azimuth = 0.0; azimuth < 6.3; azimuth += 0.1) {
    for (double elevation = -0.6; elevation < 1.5; elevation += 0.1) {
      const Eigen::Vector3d bearing(std::sin(azimuth) * std::cos(elevation),
                                    -std::sin(elevation),
                                    std::cos(azimuth) * std::cos(elevation));
      EXPECT_GT(LensRig::AxisFor(bearing).dot(bearing), std::cos(55.0 / 180.0 * std::numbers::pi));
    }
  }
}

TEST(LensRig, LosesTheShareAskedForAt45Degrees) {
  const LensRig rig{.vignetting = 0.3};
  EXPECT_DOUBLE_EQ(rig.Gain({0.0, 0.0, 1.0}), 1.0);
  EXPECT_NEAR(rig.Gain({0.0, 1.0, 1.0}), 0.7, 1e-12);
  EXPECT_DOUBLE_EQ(LensRig{}.Gain({0.0, 1.0, 1.0}), 1.0);
}

/// Rays of two rows a quarter of the height above and below the middle.
constexpr EquirectangularCamera kCamera{400, 200};

TEST(CameraRays, MeetAtTheDistanceOfStitchingWhateverTheOffset) {
  const Rigid3 cam_from_street =
      Rigid3::FromCentre(RotationFromVector({0.2, 0.5, -0.1}), {3.0, 4.0, 5.0});
  const CameraRays one(kCamera, cam_from_street, {}, {});
  const CameraRays six(kCamera, cam_from_street, {.offset_m = 0.1}, {});
  for (const double column : {10.5, 130.5, 250.5}) {
    const Eigen::Vector3d bearing = kCamera.BearingFromPixel({column, 80.5});
    const LightRay exact = one.Through(bearing, 80.5);
    const LightRay shifted = six.Through(bearing, 80.5);
    EXPECT_NEAR((shifted.origin - exact.origin).norm(), 0.1, 1e-12);
    const Eigen::Vector3d there = exact.origin + LensRig::kStitchedAt_m * exact.direction;
    EXPECT_LT((there - shifted.origin).cross(shifted.direction).norm(), 1e-9);
  }
}

TEST(CameraRays, TheMiddleRowIsExposedAtThePoseAndOthersOnTheWay) {
  const Rigid3 cam_from_street =
      Rigid3::FromCentre(RotationFromVector({0.2, 0.5, -0.1}), {3.0, 4.0, 5.0});
  const RollingShutter shutter{
      .readout_s = 0.04, .velocity_mps = {10.0, 0.0, 0.0}, .yaw_rate_rad_s = 0.5};
  const CameraRays still(kCamera, cam_from_street, {}, {});
  const CameraRays rolling(kCamera, cam_from_street, {}, shutter);
  const Eigen::Vector3d bearing = kCamera.BearingFromPixel({77.5, 100.0});
  EXPECT_LT((rolling.Through(bearing, 100.0).origin - Eigen::Vector3d(3.0, 4.0, 5.0)).norm(),
            1e-12);
  EXPECT_LT(
      (rolling.Through(bearing, 100.0).direction - still.Through(bearing, 100.0).direction).norm(),
      1e-12);
  // A quarter of the height below: a hundredth of a second later.
  const LightRay late = rolling.Through(bearing, 150.0);
  EXPECT_LT((late.origin - Eigen::Vector3d(3.1, 4.0, 5.0)).norm(), 1e-12);
  const Eigen::Vector3d turned =
      RotationFromVector({0.0, 0.0, 0.005}) * still.Through(bearing, 150.0).direction;
  EXPECT_LT((late.direction - turned).norm(), 1e-12);
}

}  // namespace
}  // namespace orbweave
