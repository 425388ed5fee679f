// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/geometry/five_point.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "core/geometry/essential.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::MakeTwoViewWorld;
using testing::TwoViewWorld;

std::span<const Vector3d, 5> FirstFive(const std::vector<Vector3d>& v) {
  return std::span<const Vector3d, 5>(v.data(), 5);
}

double DistanceToNearest(const Matrix3d& truth,
                         const absl::InlinedVector<Matrix3d, 10>& solutions) {
  double least = std::numeric_limits<double>::infinity();
  for (const Matrix3d& E : solutions)
    least = std::min({least, (E - truth).norm(), (E + truth).norm()});
  return least;
}

TEST(SolveFivePoint, FindsTheEssentialMatrixFromTheWholeSphere) {
  int num_exact = 0;
  int num_close = 0;
  constexpr int kTrials = 2000;
  for (uint64_t seed = 0; seed < kTrials; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 5);
    const auto solutions = SolveFivePoint(FirstFive(world.bearings_a), FirstFive(world.bearings_b));
    const double error = DistanceToNearest(EssentialFromPose(world.b_from_a), solutions);
    num_exact += error < 1e-6 ? 1 : 0;
    num_close += error < 1e-3 ? 1 : 0;
  }
  EXPECT_GE(num_exact, kTrials * 97 / 100);
  EXPECT_GE(num_close, kTrials * 99 / 100);  // the rest are near double solutions
}

TEST(SolveFivePoint, EverySolutionIsEssentialAndFitsTheBearings) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    const TwoViewWorld world = MakeTwoViewWorld(seed, 5);
    const auto solutions = SolveFivePoint(FirstFive(world.bearings_a), FirstFive(world.bearings_b));
    EXPECT_LE(solutions.size(), 10U);
    for (const Matrix3d& E : solutions) {
      EXPECT_NEAR(E.norm(), std::sqrt(2.0), 1e-9);
      EXPECT_NEAR(E.determinant(), 0.0, 1e-4) << seed;
      for (int i = 0; i < 5; ++i)
        EXPECT_NEAR(world.bearings_b[i].dot(E * world.bearings_a[i]), 0.0, 1e-9) << seed;
    }
  }
}

TEST(SolveFivePoint, DoesNotCareForTheSignOfBearings) {
  TwoViewWorld world = MakeTwoViewWorld(3, 5);
  world.bearings_a[1] *= -1.0;
  world.bearings_b[4] *= -1.0;
  const auto solutions = SolveFivePoint(FirstFive(world.bearings_a), FirstFive(world.bearings_b));
  EXPECT_LT(DistanceToNearest(EssentialFromPose(world.b_from_a), solutions), 1e-6);
}

TEST(SolveFivePoint, WorksOnPlanarScenes) {
  int num_exact = 0;
  for (uint64_t seed = 0; seed < 100; ++seed) {
    TwoViewWorld world = MakeTwoViewWorld(seed, 5);
    for (int i = 0; i < 5; ++i) {
      const Vector3d X(world.points_in_a[i].x(), world.points_in_a[i].y(), 3.0);
      world.bearings_a[i] = X.normalized();
      world.bearings_b[i] = testing::BearingOf(world.b_from_a, X);
    }
    const auto solutions = SolveFivePoint(FirstFive(world.bearings_a), FirstFive(world.bearings_b));
    num_exact += DistanceToNearest(EssentialFromPose(world.b_from_a), solutions) < 1e-5 ? 1 : 0;
  }
  EXPECT_GE(num_exact, 90);
}

TEST(SolveFivePoint, GivesOnlyFiniteMatricesForDegenerateBearings) {
  const std::array<Vector3d, 5> equal = {Vector3d::UnitZ(),
                                         Vector3d::UnitZ(),
                                         Vector3d::UnitZ(),
                                         Vector3d::UnitZ(),
                                         Vector3d::UnitZ()};
  for (const Matrix3d& E : SolveFivePoint(equal, equal)) EXPECT_TRUE(E.allFinite());
  const TwoViewWorld world = MakeTwoViewWorld(1, 5);
  for (const Matrix3d& E :
       SolveFivePoint(FirstFive(world.bearings_a), FirstFive(world.bearings_a))) {
    EXPECT_TRUE(E.allFinite());
  }
}

}  // namespace
}  // namespace orbweave
