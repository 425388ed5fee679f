// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/geodetic_from_enu.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

constexpr GeodeticPosition kOrigin = {22.3, 114.17, 10.0};

TEST(GeodeticFromEnu, ReturnsTheOriginForZero) {
  const GeodeticPosition p = GeodeticFromEnu(kOrigin, Eigen::Vector3d::Zero());
  EXPECT_NEAR(p.latitude_deg, kOrigin.latitude_deg, 1e-12);
  EXPECT_NEAR(p.longitude_deg, kOrigin.longitude_deg, 1e-12);
  EXPECT_NEAR(p.altitude_m, kOrigin.altitude_m, 1e-6);
}

TEST(GeodeticFromEnu, KnowsTheLengthOfADegree) {
  // At the equator a degree of longitude is pi / 180 times the equatorial radius, and one of
  // latitude is shorter by the square of the eccentricity.
  const double step_m = 1.0;
  const GeodeticPosition east = GeodeticFromEnu({0, 0, 0}, {step_m, 0, 0});
  const GeodeticPosition north = GeodeticFromEnu({0, 0, 0}, {0, step_m, 0});
  EXPECT_NEAR(step_m / east.longitude_deg, 111319.4908, 0.01);
  EXPECT_NEAR(step_m / north.latitude_deg, 110574.2758, 0.01);
}

TEST(GeodeticFromEnu, LeavesTheTangentPlaneAsTheEarthCurves) {
  const double far_m = 10000.0;
  const GeodeticPosition p = GeodeticFromEnu(kOrigin, {far_m, 0, 0});
  EXPECT_NEAR(p.altitude_m - kOrigin.altitude_m, far_m * far_m / (2.0 * 6.381e6), 0.01);
}

TEST(GeodeticFromEnu, MovesStraightUp) {
  const GeodeticPosition p = GeodeticFromEnu(kOrigin, {0, 0, 123.0});
  EXPECT_NEAR(p.altitude_m, 133.0, 1e-6);
  EXPECT_NEAR(p.latitude_deg, kOrigin.latitude_deg, 1e-11);
}

}  // namespace
}  // namespace orbweave
