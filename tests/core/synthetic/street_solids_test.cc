// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_solids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace orbweave {
namespace {

TEST(StreetSolids, HousesStandBehindThePavementsOnBothSides) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  int inside = 0;
  int outside = 0;
  for (const Solid& solid : MakeStreetSolids(layout, 3)) {
    if (solid.kind != SolidKind::kBuilding) continue;
    const double d = layout.DistanceFromAxis(solid.centre.head<2>());
    inside += d < StreetProfile::kInnerFacade_m;
    outside += d > StreetProfile::kOuterFacade_m;
    EXPECT_TRUE(d < StreetProfile::kInnerFacade_m || d > StreetProfile::kOuterFacade_m);
    EXPECT_NEAR(solid.centre.z() - solid.half.z(), kStreetGround_m, 1e-9);
  }
  EXPECT_GE(inside, 4);
  EXPECT_GE(outside, 10);
}

TEST(StreetSolids, HasEveryKindOfThing) {
  std::map<SolidKind, int> kinds;
  for (const Solid& solid : MakeStreetSolids(MakeStreetLayout(200.0), 3)) ++kinds[solid.kind];
  EXPECT_EQ(kinds.size(), 7U);
  EXPECT_EQ(kinds[SolidKind::kCarBody], kinds[SolidKind::kCarCabin]);
}

TEST(StreetSolids, MovingCarsKeepToTheirLanesAndOffTheCamera) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  Random random(4);
  size_t cars = 0;
  for (int i = 0; i < 200; ++i) {
    const double station_m = 0.7 * i;
    const Eigen::Vector2d camera = layout.axis.At(station_m).position;
    for (const Solid& part : MakeMovingCars(layout, station_m, random)) {
      const double d = layout.DistanceFromAxis(part.centre.head<2>());
      EXPECT_GT(d, -0.3);
      EXPECT_LT(d, StreetProfile::kOncomingLane_m + 0.3);
      EXPECT_GT((part.centre.head<2>() - camera).norm(), 3.0);
      ++cars;
    }
  }
  EXPECT_GT(cars, 200U);
}

}  // namespace
}  // namespace orbweave
