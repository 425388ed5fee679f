// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/street_traffic.h"

#include <gtest/gtest.h>

namespace orbweave {
namespace {

TEST(StreetTraffic, PassersAreAsManyAsAskedAndKeepOffTheCamera) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  const StreetHardships hardships{.pedestrians = 7, .vehicles = 5};
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const double station_m = 2.9 * i;
    const Eigen::Vector2d camera = layout.axis.At(station_m).position;
    int people = 0;
    int vehicles = 0;
    for (const Solid& part : MakePassers(layout, station_m, hardships, random)) {
      people += part.kind == SolidKind::kPerson;
      vehicles += part.kind == SolidKind::kBus || part.kind == SolidKind::kCarBody;
      EXPECT_GT(layout.DistanceFromAxis(part.centre.head<2>()), StreetProfile::kInnerFacade_m);
      EXPECT_LT(layout.DistanceFromAxis(part.centre.head<2>()), StreetProfile::kOuterFacade_m);
      EXPECT_GT((part.centre.head<2>() - camera).norm(), 1.0);
    }
    EXPECT_EQ(people, 7 * 4);  // two legs, trunk and head
    EXPECT_EQ(vehicles, 5);
  }
}

TEST(StreetTraffic, TheBusAheadIsAlwaysTheSame) {
  const StreetLayout layout = MakeStreetLayout(150.0);
  const Solid a = MakeBusAhead(layout, 10.0);
  const Solid b = MakeBusAhead(layout, 18.0);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.half, b.half);
  // Its rear is 5 m ahead, as seen from any place of a straight street.
  for (const auto& [bus, station_m] : {std::pair{a, 10.0}, std::pair{b, 18.0}}) {
    const PathPlace place = layout.axis.At(station_m);
    const double middle_m = (bus.centre.head<2>() - place.position).dot(place.direction);
    EXPECT_NEAR(middle_m - bus.half.x(), 5.0, 1e-9);
  }
}

}  // namespace
}  // namespace orbweave
