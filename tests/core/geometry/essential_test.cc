// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/essential.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::MakeTwoViewWorld;
using testing::RandomDirection;
using testing::RandomRotation;
using testing::RotationError;

TEST(EssentialFromPose, MakesRaysOfAPointCoplanar) {
  const auto world = MakeTwoViewWorld(1, 100);
  const Matrix3d E = EssentialFromPose(world.b_from_a);
  for (size_t i = 0; i < 100; ++i)
    EXPECT_NEAR(world.bearings_b[i].dot(E * world.bearings_a[i]), 0.0, 1e-12);
}

TEST(PosesFromEssential, HoldTheTruePoseForAnyScaleAndSign) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Rigid3 truth = {RandomRotation(random), RandomDirection(random)};
    const double scale = random.Uniform(-3.0, 3.0);
    double least = std::numeric_limits<double>::infinity();
    for (const Rigid3& pose : PosesFromEssential(scale * EssentialFromPose(truth))) {
      least = std::min(least,
                       RotationError(pose.rotation, truth.rotation) +
                           (pose.translation - truth.translation).norm());
    }
    EXPECT_LT(least, 1e-7) << trial;
  }
}

TEST(PosesFromEssential, AllHaveThisEssentialMatrixAndDiffer) {
  Random random(3);
  const Matrix3d E = EssentialFromPose({RandomRotation(random), RandomDirection(random)});
  const auto poses = PosesFromEssential(E);
  for (size_t i = 0; i < 4; ++i) {
    const Matrix3d again = EssentialFromPose(poses[i]);
    EXPECT_LT(std::min((again - E).norm(), (again + E).norm()), 1e-9);
    EXPECT_NEAR(poses[i].translation.norm(), 1.0, 1e-12);
    for (size_t j = 0; j < i; ++j) {
      EXPECT_GT(RotationError(poses[i].rotation, poses[j].rotation) +
                    (poses[i].translation - poses[j].translation).norm(),
                1.0);
    }
  }
}

TEST(NearestEssential, KeepsEssentialMatricesAndRepairsOthers) {
  Random random(4);
  const Matrix3d E = EssentialFromPose({RandomRotation(random), RandomDirection(random)});
  EXPECT_LT((NearestEssential(E) - E).norm(), 1e-12);
  const Matrix3d repaired = NearestEssential(E + 0.1 * Matrix3d::Identity());
  EXPECT_NEAR(repaired.determinant(), 0.0, 1e-12);
  const Matrix3d trace_constraint = 2.0 * repaired * repaired.transpose() * repaired -
                                    (repaired * repaired.transpose()).trace() * repaired;
  EXPECT_LT(trace_constraint.norm(), 1e-12);
}

}  // namespace
}  // namespace orbweave
