// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/alignment/submodel_level.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/rotation.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// Cameras that look anywhere, upright in a submodel in which that is `up`, but for `leans`.
std::vector<Eigen::Quaterniond> Cameras(const Vector3d& up, const std::vector<Vector3d>& leans) {
  const Eigen::Quaterniond down_from_up = RotationBetween(up, -Vector3d::UnitY());
  std::vector<Eigen::Quaterniond> cams_from_submodel;
  double azimuth = 0.0;
  for (const Vector3d& lean : leans) {
    azimuth += 1.0;
    cams_from_submodel.push_back(RotationFromVector(azimuth * Vector3d::UnitY()) *
                                 RotationFromVector(lean) * down_from_up);
  }
  return cams_from_submodel;
}

TEST(LevelOf, IsWhatCamerasCallUp) {
  const Vector3d up = Vector3d(0.3, -0.5, 0.2).normalized();
  const auto level = LevelOf(Cameras(up, std::vector<Vector3d>(30, Vector3d::Zero())));
  ASSERT_TRUE(level.has_value());
  EXPECT_LT(AngleBetween(level->up, up), 1e-9);
  EXPECT_NEAR(level->sigma_rad, 3.0 * kRadPerDeg, 1e-9);
}

TEST(LevelOf, IsTheMajoritysWhereSomeLean) {
  std::vector<Vector3d> leans(30, Vector3d::Zero());
  for (size_t i = 0; i < 10; ++i) leans[i] = 20.0 * kRadPerDeg * Vector3d::UnitX();
  const auto level = LevelOf(Cameras(Vector3d::UnitZ(), leans));
  ASSERT_TRUE(level.has_value());
  EXPECT_LT(AngleBetween(level->up, Vector3d::UnitZ()), 0.5 * kRadPerDeg);
}

TEST(LevelOf, KnowsLessOfASubmodelThatIsBent) {
  std::vector<Vector3d> leans;
  for (int i = 0; i < 30; ++i) leans.emplace_back((i - 15) * kRadPerDeg * Vector3d::UnitZ());
  const auto level = LevelOf(Cameras(Vector3d::UnitZ(), leans));
  ASSERT_TRUE(level.has_value());
  EXPECT_GT(level->sigma_rad, 6.0 * kRadPerDeg);
}

TEST(LevelOf, SaysNothingOfFewCamerasAndOfThoseHeldAnyhow) {
  EXPECT_FALSE(LevelOf(Cameras(Vector3d::UnitZ(), std::vector<Vector3d>(9, Vector3d::Zero()))));
  Random random(1);
  std::vector<Vector3d> leans;
  for (int i = 0; i < 30; ++i) leans.push_back(2.0 * testing::RandomDirection(random));
  EXPECT_FALSE(LevelOf(Cameras(Vector3d::UnitZ(), leans)));
}

}  // namespace
}  // namespace orbweave
