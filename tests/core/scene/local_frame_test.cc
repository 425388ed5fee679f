// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/scene/local_frame.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(EnuFromGeodetic, PointsEastNorthAndUp) {
  const GeodeticPosition origin{47.61, -122.32, 60.0};
  EXPECT_LT(EnuFromGeodetic(origin, origin).norm(), 1e-8);
  const Eigen::Vector3d east = EnuFromGeodetic({47.61, -122.319, 60.0}, origin);
  EXPECT_NEAR(east.x(), 75.2, 0.3);  // 1e-3 degrees times 111.4 km times cos(latitude)
  EXPECT_NEAR(east.y(), 0.0, 1e-2);
  const Eigen::Vector3d north = EnuFromGeodetic({47.611, -122.32, 60.0}, origin);
  EXPECT_NEAR(north.y(), 111.18, 0.05);
  EXPECT_NEAR(EnuFromGeodetic({47.61, -122.32, 65.0}, origin).z(), 5.0, 1e-6);
}

TEST(GeodeticFromEnu, IsTheInverseEverywhere) {
  for (const GeodeticPosition& origin : {GeodeticPosition{47.6, -122.3, 60},
                                         GeodeticPosition{-33.9, 179.9999, 5},
                                         GeodeticPosition{89.99, 12.0, 0},
                                         GeodeticPosition{0.0, 0.0, -20}}) {
    for (const Eigen::Vector3d& point : {Eigen::Vector3d(0, 0, 0),
                                         Eigen::Vector3d(120, -3500, 40),
                                         Eigen::Vector3d(-9e4, 8e4, 300)}) {
      EXPECT_LT((EnuFromGeodetic(GeodeticFromEnu(point, origin), origin) - point).norm(), 1e-6);
    }
  }
}

TEST(GeodeticFromEnu, KnowsTheLengthOfADegree) {
  // At the equator a degree of longitude is pi / 180 times the equatorial radius, and one of
  // latitude is shorter by the square of the eccentricity.
  const GeodeticPosition east = GeodeticFromEnu({1, 0, 0}, {0, 0, 0});
  const GeodeticPosition north = GeodeticFromEnu({0, 1, 0}, {0, 0, 0});
  EXPECT_NEAR(1.0 / east.longitude_deg, 111319.4908, 0.01);
  EXPECT_NEAR(1.0 / north.latitude_deg, 110574.2758, 0.01);
}

TEST(GeodeticFromEnu, LeavesTheTangentPlaneAsTheEarthCurves) {
  constexpr double kFar_m = 10000.0;
  const GeodeticPosition origin{22.3, 114.17, 10.0};
  const GeodeticPosition position = GeodeticFromEnu({kFar_m, 0, 0}, origin);
  EXPECT_NEAR(position.altitude_m - origin.altitude_m, kFar_m * kFar_m / (2.0 * 6.381e6), 0.01);
}

}  // namespace
}  // namespace orbweave
