// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/rigid3.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::RandomPoint;
using testing::RandomRotation;

TEST(Rigid3, ChainsLikeFractions) {
  Random random(1);
  const Rigid3 b_from_a = {RandomRotation(random), RandomPoint(random, 0, 5)};
  const Rigid3 c_from_b = {RandomRotation(random), RandomPoint(random, 0, 5)};
  const Vector3d P = RandomPoint(random, 0, 5);
  EXPECT_LT(((c_from_b * b_from_a) * P - c_from_b * (b_from_a * P)).norm(), 1e-12);
}

TEST(Rigid3, IsUndoneByItsInverse) {
  Random random(2);
  const Rigid3 b_from_a = {RandomRotation(random), RandomPoint(random, 0, 5)};
  const Vector3d P = RandomPoint(random, 0, 5);
  EXPECT_LT((b_from_a.Inverse() * (b_from_a * P) - P).norm(), 1e-12);
}

TEST(Rigid3, SeesItsCentreAtTheOrigin) {
  Random random(3);
  const Vector3d C = RandomPoint(random, 0, 5);
  const Rigid3 cam_from_world = Rigid3::FromCentre(RandomRotation(random), C);
  EXPECT_LT((cam_from_world * C).norm(), 1e-12);
  EXPECT_LT((cam_from_world.Centre() - C).norm(), 1e-12);
}

}  // namespace
}  // namespace orbweave
