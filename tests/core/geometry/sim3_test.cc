// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/sim3.h"

#include <gtest/gtest.h>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using testing::BearingOf;
using testing::RandomPoint;
using testing::RandomRotation;

Sim3 RandomSim3(Random& random) {
  const double scale = random.Uniform(0.2, 5.0);
  const Eigen::Quaterniond R = RandomRotation(random);
  return {scale, R, RandomPoint(random, 0, 5)};
}

TEST(Sim3, ChainsLikeFractionsAndIsUndoneByItsInverse) {
  Random random(1);
  const Sim3 b_from_a = RandomSim3(random);
  const Sim3 c_from_b = RandomSim3(random);
  const Vector3d P = RandomPoint(random, 0, 5);
  EXPECT_LT(((c_from_b * b_from_a) * P - c_from_b * (b_from_a * P)).norm(), 1e-12);
  EXPECT_LT((b_from_a.Inverse() * (b_from_a * P) - P).norm(), 1e-12);
}

TEST(TransformCamera, LeavesEveryBearingAsItWas) {
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Sim3 b_from_a = RandomSim3(random);
    const Rigid3 cam_from_a = {RandomRotation(random), RandomPoint(random, 0, 5)};
    const Rigid3 cam_from_b = TransformCamera(b_from_a, cam_from_a);
    const Vector3d P = RandomPoint(random, 0, 20);
    EXPECT_LT((BearingOf(cam_from_b, b_from_a * P) - BearingOf(cam_from_a, P)).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace orbweave
