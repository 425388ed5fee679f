// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/octahedral_normal.h"

#include <gtest/gtest.h>

#include <numbers>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

TEST(OctahedralNormal, ComesBackWithinAHundredthOfADegree) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Eigen::Vector3d unit = testing::RandomDirection(random);
    const Eigen::Vector3d back = DecodeNormal(EncodeNormal(unit.cast<float>())).cast<double>();
    EXPECT_LT(AngleBetween(unit, back), 0.005 * std::numbers::pi / 180.0) << unit.transpose();
    EXPECT_NEAR(back.norm(), 1.0, 1e-6);
  }
}

TEST(OctahedralNormal, KeepsTheAxes) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      const Eigen::Vector3f unit = sign * Eigen::Vector3f::Unit(axis);
      EXPECT_LT((DecodeNormal(EncodeNormal(unit)) - unit).norm(), 1e-6F);
    }
  }
}

}  // namespace
}  // namespace orbweave
