// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/refine_between_views.h"

#include <gtest/gtest.h>

#include "core/estimators/refine_absolute_pose.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::BearingOf;
using testing::RandomPoint;
using testing::RandomRotation;
using testing::WithNoise;

struct ViewsWorld {
  Rigid3 cam_from_world{};
  std::vector<ViewMatches> views{};
};

/// An image and three views of points all round them.
ViewsWorld MakeViewsWorld(uint64_t seed, double sigma_rad) {
  Random random(seed);
  ViewsWorld world{.cam_from_world =
                       Rigid3::FromCentre(RandomRotation(random), RandomPoint(random, 0, 5))};
  for (int view = 0; view < 3; ++view) {
    ViewMatches matches{.view_from_world = Rigid3::FromCentre(RandomRotation(random),
                                                              RandomPoint(random, 2.0, 5.0))};
    for (int i = 0; i < 40; ++i) {
      const Vector3d P = RandomPoint(random, 8.0, 20.0);
      matches.in_view.push_back(
          WithNoise(random, BearingOf(matches.view_from_world, P), sigma_rad));
      matches.in_image.push_back(WithNoise(random, BearingOf(world.cam_from_world, P), sigma_rad));
    }
    world.views.push_back(matches);
  }
  return world;
}

Rigid3 Disturbed(const Rigid3& pose) {
  Eigen::Matrix<double, 6, 1> delta;
  delta << 0.02, -0.03, 0.01, 0.2, -0.1, 0.15;
  return MovePose(pose, delta);
}

TEST(LineariseBetweenViews, HasTheGradientOfItsCost) {
  const ViewsWorld world = MakeViewsWorld(1, 1e-3);
  const Rigid3 pose = Disturbed(world.cam_from_world);
  for (const double loss_scale : {0.01, 0.3, 100.0}) {
    const auto cost = [&](const VectorXd& delta) -> VectorXd {
      return VectorXd::Constant(
          1, LineariseBetweenViews(MovePose(pose, delta), world.views, loss_scale).cost);
    };
    const VectorXd numeric = 0.5 * NumericJacobian(cost, VectorXd::Zero(6)).transpose();
    const auto analytic = LineariseBetweenViews(pose, world.views, loss_scale);
    EXPECT_LT((numeric - analytic.g).norm(), 1e-5 * analytic.g.norm()) << loss_scale;
  }
}

TEST(MinimiseBetweenViews, FindsThePoseWithoutAnyPoint) {
  const ViewsWorld world = MakeViewsWorld(2, 2e-4);
  const Rigid3 found =
      MinimiseBetweenViews(Disturbed(world.cam_from_world), world.views, {}, {}, 0.01, 30);
  EXPECT_LT((found.Centre() - world.cam_from_world.Centre()).norm(), 5e-3);
  EXPECT_LT(testing::RotationError(found.rotation, world.cam_from_world.rotation), 1e-3);
}

TEST(MinimiseBetweenViews, TakesTheLengthOfOneBaselineFromPoints) {
  ViewsWorld world = MakeViewsWorld(3, 1e-4);
  world.views.resize(1);
  Random random(5);
  std::vector<Vector3d> points;
  std::vector<Vector3d> bearings;
  for (int i = 0; i < 4; ++i) {
    points.push_back(RandomPoint(random, 8.0, 12.0));
    bearings.push_back(BearingOf(world.cam_from_world, points.back()));
  }
  const Rigid3 found = MinimiseBetweenViews(
      Disturbed(world.cam_from_world), world.views, bearings, points, 0.01, 30);
  EXPECT_LT((found.Centre() - world.cam_from_world.Centre()).norm(), 5e-3);
}

TEST(MinimiseBetweenViews, LeavesAPoseWithoutMatchesAlone) {
  const Rigid3 pose = Disturbed({});
  const Rigid3 same = MinimiseBetweenViews(pose, {}, {}, {}, 0.01, 5);
  EXPECT_EQ(same.translation, pose.translation);
}

}  // namespace
}  // namespace orbweave
