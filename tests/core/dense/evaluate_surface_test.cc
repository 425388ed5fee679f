// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/evaluate_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "core/dense/nearest_points.h"
#include "tests/support/random_world.h"

namespace orbweave {
namespace {

using Eigen::Vector3d;

/// The plane z = height over [0, length] x [0, 6], sampled every `step` metres.
std::vector<Vector3d> Plane(double length, double step, double height = 0.0) {
  std::vector<Vector3d> points;
  for (double x = 0.5 * step; x < length; x += step) {
    for (double y = 0.5 * step; y < 6.0; y += step) points.emplace_back(x, y, height);
  }
  return points;
}

TEST(NearestPoints, AgreesWithTryingAll) {
  Random random(1);
  std::vector<Vector3d> points;
  for (int i = 0; i < 3000; ++i) points.push_back(testing::RandomPoint(random, 0.0, 1.5));
  for (int i = 0; i < 1000; ++i) points.push_back(0.05 * testing::RandomPoint(random, 0.0, 1.0));
  const NearestPoints nearest(points, 0.2);
  int found = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vector3d point = testing::RandomPoint(random, 0.0, 2.0);
    double truth = std::numeric_limits<double>::infinity();
    for (const Vector3d& other : points) truth = std::min(truth, (other - point).norm());
    if (truth >= 0.2) truth = std::numeric_limits<double>::infinity();
    EXPECT_EQ(nearest.DistanceTo(point), truth);
    found += std::isfinite(truth) ? 1 : 0;
  }
  EXPECT_GT(found, 100);
  EXPECT_LT(found, 450);
}

TEST(NearestPoints, IsAtHomeFarFromTheOrigin) {
  const Vector3d far(4.5e6, -3.2e5, 812.0);
  const NearestPoints nearest(std::vector<Vector3d>{far}, 0.2);
  EXPECT_NEAR(nearest.DistanceTo(far + Vector3d(-0.1, 0.0, 0.0)), 0.1, 1e-8);
  EXPECT_TRUE(std::isinf(nearest.DistanceTo(far + Vector3d(0.0, 0.21, 0.0))));
  EXPECT_TRUE(std::isinf(nearest.DistanceTo(Vector3d::Constant(std::nan("")))));
}

TEST(EvaluateSurface, GivesAllToTheTruthItself) {
  const auto truth = Plane(10.0, 0.05);
  for (const SurfaceScore& score : EvaluateSurface(truth, truth).scores) {
    EXPECT_EQ(score.precision, 1.0);
    EXPECT_EQ(score.recall, 1.0);
    EXPECT_EQ(score.f1, 1.0);
  }
}

TEST(EvaluateSurface, FindsAShiftOfThreeCentimetresBetweenTwoAndFive) {
  const auto evaluation = EvaluateSurface(Plane(10.0, 0.02, 0.03), Plane(10.0, 0.02));
  ASSERT_EQ(evaluation.scores.size(), 4U);
  EXPECT_EQ(evaluation.scores[0].precision, 0.0);
  EXPECT_EQ(evaluation.scores[0].recall, 0.0);
  EXPECT_EQ(evaluation.scores[0].f1, 0.0);
  EXPECT_EQ(evaluation.scores[1].precision, 1.0);
  EXPECT_EQ(evaluation.scores[1].recall, 1.0);
  EXPECT_NEAR(evaluation.median_error_m, 0.03, 1e-9);
}

TEST(EvaluateSurface, SeesThatHalfIsMissing) {
  const SurfaceScore score = EvaluateSurface(Plane(5.0, 0.05), Plane(10.0, 0.05)).scores[1];
  EXPECT_EQ(score.precision, 1.0);
  EXPECT_NEAR(score.recall, 0.5, 0.011);
  EXPECT_NEAR(score.f1, 2.0 / 3.0, 0.01);
  const SurfaceScore more = EvaluateSurface(Plane(10.0, 0.05), Plane(5.0, 0.05)).scores[1];
  EXPECT_NEAR(more.precision, 0.5, 0.011);
  EXPECT_EQ(more.recall, 1.0);
}

TEST(EvaluateSurface, WeighsSurfaceAndNotSamples) {
  auto cloud = Plane(5.0, 0.01);  // right half, 25 times as dense as the wrong one
  for (const Vector3d& point : Plane(5.0, 0.05)) cloud.push_back(point + Vector3d(0, 0, 1));
  SurfaceEvaluationOptions options;
  options.voxel_m = 0.05;
  EXPECT_NEAR(EvaluateSurface(cloud, Plane(5.0, 0.02), options).scores[1].precision, 0.5, 0.01);
  auto repeated = cloud;
  for (int copy = 0; copy < 3; ++copy) {
    for (const Vector3d& point : Plane(5.0, 0.05)) repeated.push_back(point + Vector3d(0, 0, 1));
  }
  EXPECT_NEAR(EvaluateSurface(repeated, Plane(5.0, 0.02), options).scores[1].precision, 0.5, 0.01);
}

TEST(EvaluateSurface, JudgesInARegionWhatIsThere) {
  SurfaceRegion region;
  region.centres = {{1.0, 3.0, 3.0}, {2.0, 3.0, 3.0}};
  region.max_range_m = 4.0;
  const auto truth = Plane(10.0, 0.05);
  const auto near = Plane(5.0, 0.05);
  const auto evaluation = EvaluateSurface(near, truth, {}, region);
  EXPECT_EQ(evaluation.scores[1].recall, 1.0);
  EXPECT_EQ(evaluation.scores[1].precision, 1.0);
  EXPECT_LT(evaluation.cloud_points, near.size());
  EXPECT_EQ(evaluation.cloud_points, evaluation.truth_points);
}

TEST(EvaluateSurface, AnswersWithZerosWhereNothingIsToJudge) {
  const auto plane = Plane(1.0, 0.05);
  const std::vector<Vector3d> broken(3, Vector3d::Constant(std::nan("")));
  for (const auto& cloud : {std::vector<Vector3d>{}, broken}) {
    const auto evaluation = EvaluateSurface(cloud, plane);
    EXPECT_EQ(evaluation.cloud_points, 0U);
    EXPECT_EQ(evaluation.scores[3].precision, 0.0);
    EXPECT_EQ(evaluation.scores[3].recall, 0.0);
    EXPECT_EQ(evaluation.scores[3].f1, 0.0);
    EXPECT_EQ(EvaluateSurface(plane, cloud).truth_points, 0U);
  }
  EXPECT_EQ(EvaluateSurface(plane, plane, {}, SurfaceRegion{}).truth_points, 0U);
}

TEST(CountObservers, CountsWhoIsInReachAndHasNothingBefore) {
  // A floor at z = 0; a wall at x = 5 hides the floor behind it from the camera at x = 1.
  auto points = Plane(9.0, 0.05);
  const size_t floor = points.size();
  for (double y = 0.025; y < 6.0; y += 0.05) {
    for (double z = 0.025; z < 4.0; z += 0.05) points.emplace_back(5.0, y, z);
  }
  SurfaceRegion region;
  region.centres = {{1.0, 3.0, 2.0}, {8.0, 3.0, 2.0}};
  region.sample_spacing_m = 0.05;
  const auto observers = CountObservers(points, region);
  for (size_t i = 0; i < floor; ++i) {
    const double x = points[i].x();
    if (std::abs(x - 5.0) < 0.5 || (points[i] - region.centres[0]).norm() < 2.0) continue;
    if ((points[i] - region.centres[1]).norm() < 2.0) continue;
    EXPECT_EQ(observers[i], 1) << points[i].transpose();
  }
  region.sample_spacing_m = 0.0;
  EXPECT_EQ(CountObservers(points, region), CountInReach(points, region));
  EXPECT_EQ(CountInReach(points, region)[floor / 2], 2);
}

}  // namespace
}  // namespace orbweave
