// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/adjustment/adapt_to_parallax.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/core/mapping/slow_street.h"

namespace orbweave {
namespace {

constexpr double kPixel_deg = 360.0 / 5400.0;

CorrespondenceGraph GraphOf(const RayStreet& world) {
  return BuildCorrespondenceGraph(world.problem).value();
}

MappingOptions Adapted(const RayStreet& world, const MappingOptions& options = {}) {
  return AdaptToParallax(world.problem, GraphOf(world), options);
}

TEST(AdaptToParallax, LeavesAStreetAsItIs) {
  const MappingOptions adapted = Adapted(MakeStreet({.centres = StraightWalk(12, 3.0)}));
  EXPECT_EQ(adapted.min_angle_deg, MappingOptions{}.min_angle_deg);
  EXPECT_EQ(adapted.max_error_px, MappingOptions{}.max_error_px);
}

TEST(AdaptToParallax, AsksLessOfACameraThatHardlyMoves) {
  const RayStreet world = MakeSlowStreet(20, 0.005);
  const MappingOptions adapted = Adapted(world);
  const double parallax_deg = ParallaxOf(world.problem, GraphOf(world)) * 180.0 / std::numbers::pi;
  EXPECT_DOUBLE_EQ(adapted.min_angle_deg, parallax_deg / 3.0);
  EXPECT_LT(adapted.min_angle_deg, 0.5 * MappingOptions{}.min_angle_deg);
  EXPECT_LE(adapted.max_error_px, MappingOptions{}.max_error_px);
}

TEST(AdaptToParallax, AllowsNoMoreErrorThanItAsksParallax) {
  const MappingOptions adapted = Adapted(MakeSlowStreet(20, 0.001));
  EXPECT_LT(adapted.max_error_px, MappingOptions{}.max_error_px);
  EXPECT_NEAR(adapted.max_error_px * kPixel_deg, adapted.min_angle_deg, 1e-9);
}

TEST(AdaptToParallax, AsksHalfAPixelAtLeast) {
  const MappingOptions adapted = Adapted(MakeSlowStreet(10, 1e-6));
  EXPECT_GE(adapted.min_angle_deg, 0.5 * kPixel_deg - 1e-12);
  EXPECT_GE(adapted.max_error_px, 0.5 - 1e-9);
}

TEST(AdaptToParallax, TakesNoAccountOfRotations) {
  const RayStreet upright = MakeSlowStreet(12, 0.005);
  const RayStreet turned = MakeSlowStreet(12, 0.005, true);
  EXPECT_NEAR(ParallaxOf(turned.problem, GraphOf(turned)),
              ParallaxOf(upright.problem, GraphOf(upright)),
              5e-4);  // by so much pairs know the rotation
}

TEST(AdaptToParallax, IsNotMisledByAStop) {
  // Four fifths of the panoramas stand at one place, and see none of the others.
  std::vector<Eigen::Vector3d> centres = StraightWalk(10, 3.0);
  centres.resize(50, centres.back());
  const MappingOptions adapted = Adapted(MakeStreet({.centres = centres, .window = 9}));
  EXPECT_EQ(adapted.min_angle_deg, MappingOptions{}.min_angle_deg);
}

TEST(AdaptToParallax, LeavesOptionsWithoutMatches) {
  RayStreet world = MakeStreet({.centres = StraightWalk(4, 3.0)});
  world.problem.pairs.clear();
  EXPECT_EQ(ParallaxOf(world.problem, GraphOf(world)), 0.0);
  EXPECT_EQ(Adapted(world).min_angle_deg, MappingOptions{}.min_angle_deg);
}

}  // namespace
}  // namespace orbweave
