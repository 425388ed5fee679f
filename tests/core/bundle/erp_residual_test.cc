// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/erp_residual.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/bundle/adjust_bundle.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/ceres_adjuster.h"
#include "core/geometry/equirectangular_camera.h"
#include "tests/core/bundle/bundle_world.h"
#include "tests/support/numeric_jacobian.h"

namespace orbweave {
namespace {

constexpr EquirectangularCamera kCamera = {4000, 2000};

/// A ray at this longitude and latitude, degrees.
Eigen::Vector3d RayAt(double longitude_deg, double latitude_deg) {
  const double longitude = longitude_deg * std::numbers::pi / 180.0;
  const double latitude = latitude_deg * std::numbers::pi / 180.0;
  return {std::cos(latitude) * std::sin(longitude),
          std::sin(latitude),
          std::cos(latitude) * std::cos(longitude)};
}

Eigen::Vector2d Residual(const Eigen::Vector3d& ray, const Eigen::Vector3d& bearing) {
  return EvaluateErpResidual(
             Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 3.0 * ray, bearing)
      .r;
}

TEST(ErpResidual, IsTheDistanceInThePixelsOfTheImage) {
  for (const double latitude_deg : {-70.0, -20.0, 0.0, 45.0, 80.0}) {
    const Eigen::Vector3d ray = RayAt(30.0, latitude_deg);
    const Eigen::Vector3d bearing = RayAt(30.7, latitude_deg - 0.4);
    const Eigen::Vector2d pixels =
        kCamera.PixelFromBearing(ray) - kCamera.PixelFromBearing(bearing);
    EXPECT_LT((Residual(ray, bearing) / kCamera.AngleFromPixels(1.0) - pixels).norm(), 1e-9);
  }
}

TEST(ErpResidual, GoesTheShortWayRoundTheSeam) {
  EXPECT_NEAR(
      Residual(RayAt(179.5, 10.0), RayAt(-179.5, 10.0)).x(), -std::numbers::pi / 180.0, 1e-12);
  EXPECT_NEAR(
      Residual(RayAt(-179.5, 10.0), RayAt(179.5, 10.0)).x(), std::numbers::pi / 180.0, 1e-12);
}

TEST(ErpResidual, WeighsTheParallelByItsLatitude) {
  // An error of the same angle along the parallel: longer by 1 / cos(60 degrees) in the image.
  const Eigen::Vector3d ray = RayAt(0.0, 60.0);
  const Eigen::Vector3d off = (ray + 1e-5 * Eigen::Vector3d::UnitX()).normalized();
  EXPECT_NEAR(Residual(off, ray).norm(), 2e-5, 1e-9);
  const Eigen::Vector3d along = (ray + 1e-5 * RayAt(0.0, 150.0)).normalized();
  EXPECT_NEAR(Residual(along, ray).norm(), 1e-5, 1e-9);
}

TEST(ErpResidual, JacobiansAgreeWithNumericOnes) {
  Random random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::Quaterniond R = RotationFromVector(RandomVector(random));
    const Eigen::Vector3d C = RandomVector(random);
    const Eigen::Vector3d X = 5.0 * RandomVector(random);
    const Eigen::Vector3d ray = (R * (X - C)).normalized();
    if (std::abs(ray.y()) > 0.999) continue;  // differences are no derivatives there
    const Eigen::Vector3d bearing = (ray + 0.1 * RandomVector(random)).normalized();
    const auto f = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
      const Eigen::Matrix3d turned = (R * RotationFromVector(x.head<3>())).toRotationMatrix();
      return EvaluateErpResidual(turned, C + x.segment<3>(3), X + x.tail<3>(), bearing).r;
    };
    const Eigen::MatrixXd numeric = NumericJacobian(f, Eigen::VectorXd::Zero(9));
    const BearingResidual residual = EvaluateErpResidual(R.toRotationMatrix(), C, X, bearing);
    const double size = 1.0 + numeric.norm() * numeric.norm();
    EXPECT_LT((residual.d_pose - numeric.leftCols<6>()).norm(), 1e-7 * size);
    EXPECT_LT((residual.d_point - numeric.rightCols<3>()).norm(), 1e-7 * size);
  }
}

TEST(ErpResidual, IsFiniteAtThePolesAndInTheCentre) {
  const Eigen::Vector3d pole = -Eigen::Vector3d::UnitY();
  const BearingResidual up =
      EvaluateErpResidual(Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero(), 2.0 * pole, pole);
  EXPECT_TRUE(up.r.allFinite());
  EXPECT_TRUE(up.d_pose.allFinite());
  EXPECT_TRUE(up.d_point.allFinite());
  const BearingResidual none = EvaluateErpResidual(
      Eigen::Matrix3d::Identity(), Eigen::Vector3d::Ones(), Eigen::Vector3d::Ones(), pole);
  EXPECT_EQ(none.r, Eigen::Vector2d::Zero());
}

/// Panoramas that stand upright, as cameras do, so that latitudes say something.
BundleWorld UprightWorld(double outlier_share) {
  BundleWorld world = MakeBundleWorld({.num_poses = 10, .outlier_share = outlier_share});
  // x right along the street, y down, z across.
  Eigen::Matrix3d upright;
  upright << 1.0, 0.0, 0.0, 0.0, 0.0, -1.0, 0.0, 1.0, 0.0;
  for (size_t i = 0; i < world.truth.cams_from_world.size(); ++i) {
    const Eigen::Quaterniond turn(
        upright * world.truth.cams_from_world[i].rotation.conjugate().toRotationMatrix());
    for (BundleProblem* problem : {&world.truth, &world.start}) {
      Rigid3& pose = problem->cams_from_world[i];
      pose = Rigid3::FromCentre((turn * pose.rotation).normalized(), pose.Centre());
      for (BundleObservation& seen : problem->observations)
        if (seen.pose == i) seen.bearing = turn * seen.bearing;
    }
  }
  return world;
}

TEST(AdjustBundleByErpPixels, ReachesTheCostOfCeres) {
  for (const BundleLoss loss :
       {BundleLoss::kLeastSquares, BundleLoss::kCauchy, BundleLoss::kHuber}) {
    const BundleWorld world = UprightWorld(loss == BundleLoss::kLeastSquares ? 0.0 : 0.02);
    const BundleOptions options = {.loss = loss,
                                   .max_iterations = 1000,
                                   .function_tolerance = 1e-15,
                                   .residual = BundleResidual::kErpPx};
    BundleProblem ours = world.start;
    BundleProblem theirs = world.start;
    const auto report = AdjustBundle(ours, options, {});
    const auto oracle = AdjustBundleWithCeres(theirs, options, {});
    ASSERT_TRUE(report.ok() && oracle.ok());
    EXPECT_NEAR(report->initial_cost, oracle->initial_cost, 1e-12 * oracle->initial_cost);
    EXPECT_NEAR(report->final_cost, oracle->final_cost, 1e-8 * oracle->final_cost)
        << internal::ValueToText(loss);
    EXPECT_LT(report->final_cost, 0.5 * report->initial_cost);
  }
}

TEST(AdjustBundleByErpPixels, HasAnotherSolutionThanByAngles) {
  const BundleWorld world = UprightWorld(0.0);
  const auto cost_in_pixels = [](const BundleProblem& problem) {
    double cost = 0.0;
    for (const BundleObservation& seen : problem.observations) {
      const Rigid3& pose = problem.cams_from_world[seen.pose];
      cost += EvaluateErpResidual(pose.rotation.toRotationMatrix(),
                                  pose.Centre(),
                                  problem.points_in_world[seen.point],
                                  seen.bearing)
                  .r.squaredNorm();
    }
    return cost;
  };
  BundleOptions options = {
      .loss = BundleLoss::kLeastSquares, .max_iterations = 200, .function_tolerance = 1e-15};
  BundleProblem by_angles = world.start;
  ASSERT_TRUE(AdjustBundle(by_angles, options, {}).ok());
  options.residual = BundleResidual::kErpPx;
  BundleProblem by_pixels = world.start;
  ASSERT_TRUE(AdjustBundle(by_pixels, options, {}).ok());
  EXPECT_LT(cost_in_pixels(by_pixels), 0.9995 * cost_in_pixels(by_angles));
}

TEST(AdjustBundleByErpPixels, GivesTheSameBytesForAnyNumberOfThreads) {
  const BundleWorld world = UprightWorld(0.02);
  const BundleOptions options = {.residual = BundleResidual::kErpPx};
  BundleProblem one = world.start;
  BundleProblem four = world.start;
  ASSERT_TRUE(AdjustBundle(one, options, {.num_threads = 1}).ok());
  ASSERT_TRUE(AdjustBundle(four, options, {.num_threads = 4}).ok());
  EXPECT_EQ(one.points_in_world, four.points_in_world);
}

}  // namespace
}  // namespace orbweave
