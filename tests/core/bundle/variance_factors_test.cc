// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/variance_factors.h"

#include <gtest/gtest.h>

#include "core/bundle/adjust_bundle.h"
#include "tests/core/bundle/bundle_world.h"

namespace orbweave {
namespace {

VarianceFactors Estimate(const BundleProblem& problem, int num_threads = 1) {
  const Gauge gauge = ChooseGauge(problem);
  const BundleLayout layout = MakeBundleLayout(problem, gauge);
  return EstimateVarianceFactors(problem, layout, InitialState(problem), gauge, num_threads);
}

// Positions of every panorama, off by normal noise of `noise_m` per axis, a share by 50 m.
void AddPositions(double noise_m,
                  const Eigen::Vector3d& sigma_m,
                  double outlier_share,
                  BundleProblem& problem) {
  Random random(5);
  for (uint32_t i = 0; i < problem.cams_from_world.size(); ++i) {
    Eigen::Vector3d error = noise_m * RandomVector(random);
    if (random.Uniform() < outlier_share) error += Eigen::Vector3d(50.0, -50.0, 50.0);
    problem.position_priors.push_back(
        {.pose = i,
         .position_in_world = problem.cams_from_world[i].Centre() + error,
         .sigma_m = sigma_m});
  }
}

TEST(EstimateVarianceFactors, FindsHowMuchNoiserBearingsAreThanTheyClaim) {
  for (const double share : {0.5, 1.0, 3.0}) {
    BundleProblem problem = MakeBundleWorld({.num_poses = 20, .num_points = 1500}).truth;
    for (BundleObservation& seen : problem.observations) seen.sigma_rad /= share;
    ASSERT_TRUE(AdjustBundle(problem, {.loss = BundleLoss::kLeastSquares}, {}).ok());
    EXPECT_NEAR(Estimate(problem).bearings, share * share, 0.05 * share * share);
  }
}

TEST(EstimateVarianceFactors, FindsTheNoiseOfPositionsPerAxisInSpiteOfOutliers) {
  for (const double outlier_share : {0.0, 0.1}) {
    BundleProblem problem = MakeBundleWorld({.num_poses = 1500, .num_points = 0}).truth;
    AddPositions(0.6, {1.2, 1.2, 0.6}, outlier_share, problem);
    const Eigen::Vector3d factors = Estimate(problem).positions;
    EXPECT_EQ(factors[0], factors[1]);
    // An M-estimate is somewhat worse than the mean even of normal errors.
    EXPECT_GT(factors[0], 0.25);
    EXPECT_LT(factors[0], 0.25 * 1.5);
    EXPECT_GT(factors[2], 1.0);
    EXPECT_LT(factors[2], 1.5);
  }
}

TEST(EstimateVarianceFactors, UnknownHeightsSayNothingOfKnownOnes) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 1500, .num_points = 0}).truth;
  AddPositions(0.6, {1.2, 1.2, 0.6}, 0.0, problem);
  for (uint32_t i = 0; i < 1500; i += 2) {
    PositionPrior& prior = problem.position_priors[i];
    prior.is_height_known = false;
    prior.sigma_m.z() = 1e5;
  }
  const Eigen::Vector3d half = Estimate(problem).positions;
  EXPECT_GT(half.z(), 0.9);
  EXPECT_LT(half.z(), 1.6);
  for (PositionPrior& prior : problem.position_priors) prior.is_height_known = false;
  EXPECT_EQ(Estimate(problem).positions.z(), 1.0);
}

// Residuals of four positions, seven unknowns taken off, may be next to nothing by chance.
TEST(EstimateVarianceFactors, DoesNotTakeAFewForExactThatAgreeByChance) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 4, .num_points = 0}).truth;
  AddPositions(0.0, {2.0, 2.0, 4.0}, 0.0, problem);
  EXPECT_GT(Estimate(problem).positions.minCoeff(), 0.5);
  BundleProblem many = MakeBundleWorld({.num_poses = 1500, .num_points = 0}).truth;
  AddPositions(0.0, {2.0, 2.0, 4.0}, 0.0, many);
  EXPECT_LT(Estimate(many).positions.maxCoeff(), 0.01);
}

TEST(EstimateVarianceFactors, BelievesTheClaimsWhereNothingIsRedundant) {
  BundleProblem problem = MakeBundleWorld({.num_poses = 2, .num_points = 0}).truth;
  AddPositions(10.0, {1.0, 1.0, 1.0}, 0.0, problem);
  const VarianceFactors factors = Estimate(problem);
  EXPECT_EQ(factors.bearings, 1.0);
  EXPECT_EQ(factors.positions, Eigen::Vector3d::Ones());
}

TEST(EstimateVarianceFactors, StaysPositiveForExactData) {
  BundleProblem problem = MakeBundleWorld({.sigma_rad = 1e-13}).truth;
  for (BundleObservation& seen : problem.observations) seen.sigma_rad = 1e-3;
  AddPositions(0.0, {1.0, 1.0, 1.0}, 0.0, problem);
  const VarianceFactors factors = Estimate(problem);
  EXPECT_GT(factors.bearings, 0.0);
  EXPECT_GT(factors.positions.minCoeff(), 0.0);
}

}  // namespace
}  // namespace orbweave
