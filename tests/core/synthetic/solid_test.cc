// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/solid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbweave {
namespace {

const Eigen::Vector2d kDiagonal = Eigen::Vector2d(1.0, 1.0).normalized();

TEST(Solid, IsHitWhereTheTurnedBoxBegins) {
  const Solid box{.centre = {10.0, 0.0, 0.0}, .half = {1.0, 1.0, 1.0}, .along = kDiagonal};
  const SolidHit hit = Intersect({{0.0, 0.1, 0.0}, Eigen::Vector3d::UnitX()}, box);
  EXPECT_NEAR(hit.distance_m, 10.0 - std::sqrt(2.0) + 0.1, 1e-12);
}

TEST(Solid, NormalsPointAgainstTheRay) {
  const Solid box{.centre = {4.0, 3.0, 1.0}, .half = {1.0, 0.5, 2.0}, .along = kDiagonal};
  Solid crown = box;
  crown.kind = SolidKind::kCrown;
  for (const Solid& solid : {box, crown}) {
    const LightRay ray{Eigen::Vector3d::Zero(), solid.centre.normalized()};
    const SolidHit hit = Intersect(ray, solid);
    ASSERT_GE(hit.face, 0);
    const Eigen::Vector3d normal =
        SurfaceNormal(solid, hit.face, ray.origin + hit.distance_m * ray.direction);
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
    EXPECT_LT(normal.dot(ray.direction), 0.0);
  }
}

TEST(Solid, EllipsoidTouchesItsBox) {
  const Solid crown{.kind = SolidKind::kCrown, .centre = {5.0, 0.0, 0.0}, .half = {2.0, 1.0, 1.0}};
  EXPECT_NEAR(
      Intersect({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, crown).distance_m, 3.0, 1e-12);
  EXPECT_EQ(Intersect({{0.0, 0.99, 0.99}, Eigen::Vector3d::UnitX()}, crown).face, -1);
}

TEST(Solid, IsNotHitFromInsideOrBehind) {
  const Solid box{};
  EXPECT_EQ(Intersect({Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()}, box).face, -1);
  EXPECT_EQ(Intersect({{5.0, 0.0, 0.0}, Eigen::Vector3d::UnitX()}, box).face, -1);
}

}  // namespace
}  // namespace orbweave
