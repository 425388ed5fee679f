// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/angle_to_arc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

TEST(AngleToArc, IsThatToTheNearestOfItsDirections) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d first = testing::RandomDirection(random);
    const Vector3d last = testing::RandomDirection(random);
    const Vector3d direction = testing::RandomDirection(random);
    double nearest = 10.0;
    for (int i = 0; i <= 2000; ++i) {
      const double share = i / 2000.0;
      nearest = std::min(nearest, AngleBetween((1.0 - share) * first + share * last, direction));
    }
    EXPECT_NEAR(AngleToArc(direction, first, last), nearest, 5e-3) << trial;
  }
}

TEST(AngleToArc, OfOneDirectionIsTheAngleToIt) {
  const Vector3d up = Vector3d::UnitZ();
  EXPECT_NEAR(AngleToArc(Vector3d::UnitX(), up, up), AngleBetween(Vector3d::UnitX(), up), 1e-12);
  EXPECT_NEAR(AngleToArc(up, up, up), 0.0, 1e-12);
}

}  // namespace
}  // namespace orbweave
