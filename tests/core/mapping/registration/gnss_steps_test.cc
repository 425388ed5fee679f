// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/gnss_steps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/mapping/true_state.h"

namespace orbweave {
namespace {

TEST(GnssSteps, AreHorizontalAndAsExactAsBothPositions) {
  StreetFixture street({.centres = StraightWalk(3, 3.0), .window = 1});
  const auto prior = [&](ImageSlot image) -> PosePrior& {
    return street.world.problem.images[image].prior;
  };
  prior(0).position_in_enu = Eigen::Vector3d(10.0, 0.0, 5.0);
  prior(0).horizontal_sigma_m = 3.0;
  prior(1).position_in_enu = Eigen::Vector3d(10.0, 20.0, 95.0);
  prior(1).horizontal_sigma_m = 4.0;
  const std::vector<GnssStep> steps =
      GnssSteps(street.world.problem, street.graph, std::vector<uint32_t>{0, 1});
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_DOUBLE_EQ(steps[0].log_length, std::log(20.0));
  EXPECT_DOUBLE_EQ(steps[0].sigma, 0.25);
  EXPECT_TRUE(std::isinf(steps[1].sigma)) << "the third has no position";
}

/// Steps of 8 to 12 m with independent positions, stated as good to `stated_m`, that have errors
/// of `true_m` in each axis.
double FactorWith(double stated_m, double true_m, uint32_t count) {
  Random random(5);
  std::vector<GnssStep> steps;
  std::vector<SeenRatio> ratios;
  std::vector<double> truths;
  for (uint32_t i = 0; i < count; ++i) {
    const double length_m = random.Uniform(8.0, 12.0);
    const double error_m = std::sqrt(2.0) * true_m * random.Normal();
    steps.push_back({std::log(length_m + error_m), std::sqrt(2.0) * stated_m / length_m});
    truths.push_back(length_m);
    if (i > 0) ratios.push_back({i - 1, i, std::log(truths[i] / truths[i - 1])});
  }
  return FactorOfSteps(steps, ratios);
}

TEST(FactorOfSteps, IsOneForSigmasThatHold) { EXPECT_NEAR(FactorWith(0.5, 0.5, 2000), 1.0, 0.1); }

TEST(FactorOfSteps, SaysHowMuchMoreExactStepsAreThanPositions) {
  EXPECT_NEAR(FactorWith(5.0, 0.5, 2000), 0.1, 0.01);
}

TEST(FactorOfSteps, SaysThatAReceiverPromisesTooMuch) {
  EXPECT_GT(FactorWith(0.1, 0.5, 2000), 4.0);
}

TEST(FactorOfSteps, BelievesWhatIsStatedWhereLittleIsSeen) {
  EXPECT_EQ(FactorWith(5.0, 0.5, 15), 1.0);
}

TEST(FactorOfErrors, IsThatOfTheBestQuarter) {
  Random random(7);
  std::vector<double> errors;
  for (int i = 0; i < 4000; ++i) errors.push_back(std::abs(3.0 * random.Normal()));
  EXPECT_NEAR(FactorOfErrors(errors), 3.0, 0.2);
  for (size_t i = 0; i < errors.size() / 10; ++i) errors[i] += 100.0;
  EXPECT_NEAR(FactorOfErrors(errors), 3.0, 0.5) << "a tenth is wrong";
}

TEST(FactorOfErrors, OfFewIsNoReasonToTrustThem) {
  EXPECT_EQ(FactorOfErrors({0.1, 0.1, 0.1}), 2.0);
  EXPECT_EQ(FactorOfErrors({}), 2.0);
  EXPECT_GT(FactorOfErrors({9.0, 9.0, 9.0}), 20.0);
}

}  // namespace
}  // namespace orbweave
