// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/split_by_motion.h"

#include <gtest/gtest.h>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

TEST(SplitByMotion, KeepsTheOrderAndMeasuresTheAngle) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d near_x = RotationFromVector({0.0, 0.0, 0.009}) * x;
  const Eigen::Vector3d far_x = RotationFromVector({0.0, 0.0, 0.011}) * x;
  const std::vector<Eigen::Vector3d> in_a = {x, y};
  const std::vector<Eigen::Vector3d> in_b = {far_x, near_x, y, x};
  const std::vector<FeatureMatch> matches = {{0, 0}, {0, 1}, {1, 2}, {1, 3}};
  const MatchesByMotion split = SplitByMotion(in_a, in_b, matches, 0.01);
  EXPECT_EQ(split.moved, (std::vector<FeatureMatch>{{0, 0}, {1, 3}}));
  EXPECT_EQ(split.fixed, (std::vector<FeatureMatch>{{0, 1}, {1, 2}}));
  EXPECT_DOUBLE_EQ(split.fixed_spread, 2.0 / 64.0);
}

TEST(SplitByMotion, OfNothingIsNothing) {
  const MatchesByMotion split = SplitByMotion({}, {}, {}, 0.01);
  EXPECT_TRUE(split.moved.empty() && split.fixed.empty());
  EXPECT_EQ(split.fixed_spread, 0.0);
}

}  // namespace
}  // namespace orbweave
