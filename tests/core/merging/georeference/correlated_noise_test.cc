// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/correlated_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kStep = 3.0;

// Shift and slope of `count` measurements whose errors fade over `length` (0: not correlated).
struct Fitted {
  NoiseRun run{};
  double error = 0.0;             // of the shift
  double claimed_variance = 0.0;  // if errors were independent
};

Fitted FitLine(int count, double length, Random& random) {
  Fitted fitted;
  Eigen::MatrixXd& X = fitted.run.design;
  X.resize(count, 2);
  Eigen::VectorXd errors(count);
  const double kept = length > 0.0 ? std::exp(-kStep / length) : 0.0;
  double noise = random.Normal();
  for (int i = 0; i < count; ++i) {
    if (i > 0) noise = kept * noise + std::sqrt(1.0 - kept * kept) * random.Normal();
    errors[i] = noise;
    X.row(i) << 1.0, static_cast<double>(i) / count - 0.5;
    fitted.run.places.push_back(kStep * i);
  }
  const Eigen::Matrix2d A = X.transpose() * X;
  const Eigen::Vector2d solution = A.ldlt().solve(X.transpose() * errors);
  fitted.run.residuals = errors - X * solution;
  fitted.error = solution[0];
  fitted.claimed_variance = fitted.run.residuals.squaredNorm() / (count - 2) * A.inverse()(0, 0);
  return fitted;
}

CorrelatedNoise NoiseOf(const NoiseRun& run) {
  return EstimateCorrelatedNoise(
             {{.runs = {run}, .information = Eigen::VectorXd::Zero(run.design.cols())}})
      .front();
}

struct Tally {
  double ratio = 0.0;      // squared error over variance, mean
  double inflation = 0.0;  // mean
};

Tally TallyOf(int count, double length) {
  constexpr int kTrials = 60;
  Random random(7);
  Tally tally;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Fitted fitted = FitLine(count, length, random);
    const CorrelatedNoise noise = NoiseOf(fitted.run);
    tally.ratio +=
        fitted.error * fitted.error / (fitted.claimed_variance * noise.inflations[0]) / kTrials;
    tally.inflation += noise.inflation / kTrials;
  }
  return tally;
}

TEST(EstimateCorrelatedNoise, LeavesIndependentErrorsAlone) {
  const Tally tally = TallyOf(200, 0.0);
  EXPECT_LT(tally.inflation, 1.6);
  EXPECT_GT(tally.ratio, 0.5);
  EXPECT_LT(tally.ratio, 1.5);
}

TEST(EstimateCorrelatedNoise, ClaimsWhatCorrelatedErrorsDo) {
  for (const double length : {30.0, 150.0}) {
    const Tally tally = TallyOf(200, length);
    EXPECT_GT(tally.inflation, 10.0) << length;
    EXPECT_GT(tally.ratio, 0.4) << length;
    EXPECT_LT(tally.ratio, 2.5) << length;
  }
}

TEST(EstimateCorrelatedNoise, FindsHowFarErrorsHangTogether) {
  Random random(3);
  const Fitted fitted = FitLine(3000, 30.0, random);
  const CorrelatedNoise noise = NoiseOf(fitted.run);
  EXPECT_GT(noise.share, 0.8);
  EXPECT_GT(noise.length, 15.0);
  EXPECT_LT(noise.length, 60.0);
}

TEST(EstimateCorrelatedNoise, DoesNotDependOnUnits) {
  Random random(4);
  Fitted fitted = FitLine(100, 30.0, random);
  const CorrelatedNoise before = NoiseOf(fitted.run);
  for (double& place : fitted.run.places) place *= 1000.0;
  const CorrelatedNoise after = NoiseOf(fitted.run);
  EXPECT_NEAR(after.inflation, before.inflation, 1e-6 * before.inflation);
  EXPECT_NEAR(after.length, 1000.0 * before.length, 1e-6 * after.length);
}

TEST(EstimateCorrelatedNoise, IsSilentAboutTooFewAndAboutExactMeasurements) {
  Random random(5);
  const Fitted few = FitLine(4, 0.0, random);
  EXPECT_EQ(NoiseOf(few.run).inflation, 1.0);
  Fitted exact = FitLine(50, 0.0, random);
  exact.run.residuals.setZero();
  EXPECT_EQ(NoiseOf(exact.run).inflation, 1.0);
}

// Along a way no longer than errors hang together an axis by itself may look independent.
TEST(EstimateCorrelatedNoise, AnAxisClaimsWhatAnotherTellsOfIt) {
  Random random(6);
  NoiseAxis telling{.information = Eigen::VectorXd::Zero(2)};
  for (int run = 0; run < 4; ++run) telling.runs.push_back(FitLine(300, 60.0, random).run);
  NoiseAxis silent{.information = Eigen::VectorXd::Zero(2)};
  silent.runs.push_back(FitLine(60, 0.0, random).run);
  const double alone = EstimateCorrelatedNoise({silent}).front().inflation;
  const std::vector<CorrelatedNoise> both = EstimateCorrelatedNoise({telling, silent});
  EXPECT_LT(alone, 2.0);
  EXPECT_GT(both[1].inflation, 5.0);
  EXPECT_GE(both[0].inflation, EstimateCorrelatedNoise({telling}).front().inflation);
}

TEST(EstimateCorrelatedNoise, AnAxisThatIsExactSaysNothingOfAnother) {
  Random random(8);
  NoiseAxis axis{.information = Eigen::VectorXd::Zero(2)};
  axis.runs.push_back(FitLine(100, 30.0, random).run);
  NoiseAxis exact = axis;
  exact.runs.front().residuals.setZero();
  const double alone = EstimateCorrelatedNoise({axis}).front().inflation;
  EXPECT_EQ(EstimateCorrelatedNoise({exact, axis})[1].inflation, alone);
  EXPECT_EQ(EstimateCorrelatedNoise({axis, exact})[1].inflation, 1.0);
}

}  // namespace
}  // namespace orbweave
