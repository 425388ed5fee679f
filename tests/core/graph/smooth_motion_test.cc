// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/smooth_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/random.h"

namespace orbweave {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

/// p(t) = (3, -2) + (8, 1) t.
Eigen::RowVector2d Straight(double time_s) { return {3.0 + 8.0 * time_s, time_s - 2.0}; }

TEST(SmoothMotion, LeavesAStraightWayAsItIs) {
  const std::vector<double> times_s = {0.0, 0.5, 0.5, 2.0, 2.25, 7.0};
  Eigen::MatrixXd measured(6, 2);
  for (int i = 0; i < 6; ++i) measured.row(i) = Straight(times_s[static_cast<size_t>(i)]);
  const SmoothedMotion smoothed =
      SmoothMotion(times_s, measured, Eigen::VectorXd::Constant(6, 4.0), 9.0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_LT((smoothed.positions.row(i) - measured.row(i)).norm(), 0.3) << i;
    EXPECT_LT(smoothed.variances[i], 4.0);
  }
}

TEST(SmoothMotion, FillsWhatIsNotMeasuredAndSaysHowWell) {
  const std::vector<double> times_s = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  Eigen::MatrixXd measured = Eigen::MatrixXd::Zero(7, 2);
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(7, 1e-6);
  for (int i = 0; i < 7; ++i) measured.row(i) = Straight(i);
  measured.row(3).setConstant(1e3);
  variances[3] = kNothing;
  const SmoothedMotion smoothed = SmoothMotion(times_s, measured, variances, 9.0);
  EXPECT_LT((smoothed.positions.row(3) - Straight(3.0)).norm(), 1e-3);
  EXPECT_GT(smoothed.variances[3], 0.1);
  EXPECT_LT(smoothed.variances[2], 1e-5);
}

/// Law: values and variances do not depend on which end of the way is called its beginning, nor on
/// where the frame's origin is.
TEST(SmoothMotion, IsTheSameBackwardsAndElsewhere) {
  Random random(3);
  std::vector<double> times_s;
  std::vector<double> backwards_s;
  Eigen::MatrixXd measured(30, 2);
  Eigen::VectorXd variances(30);
  for (int i = 0; i < 30; ++i) {
    times_s.push_back(i == 0 ? 0.0 : times_s.back() + random.Uniform(0.2, 3.0));
    measured.row(i) << random.Uniform(-50.0, 50.0), random.Uniform(-50.0, 50.0);
    variances[i] = random.Uniform(0.5, 9.0);
  }
  for (int i = 29; i >= 0; --i) backwards_s.push_back(-times_s[static_cast<size_t>(i)]);
  const SmoothedMotion ahead = SmoothMotion(times_s, measured, variances, 4.0);
  const Eigen::RowVector2d shift(100.0, -40.0);
  const SmoothedMotion back = SmoothMotion(
      backwards_s, measured.colwise().reverse().rowwise() + shift, variances.reverse(), 4.0);
  for (int i = 0; i < 30; ++i) {
    EXPECT_LT((back.positions.row(29 - i) - shift - ahead.positions.row(i)).norm(), 0.02) << i;
    EXPECT_NEAR(back.variances[29 - i], ahead.variances[i], 1e-3 * ahead.variances[i]);
  }
}

/// Errors of a motion that is what it is taken for are as large as is said.
TEST(SmoothMotion, ClaimsWhatItHolds) {
  Random random(7);
  constexpr double kDensity = 4.0;
  double squares = 0.0;
  int count = 0;
  for (int run = 0; run < 40; ++run) {
    std::vector<double> times_s;
    Eigen::MatrixXd truth(50, 1);
    Eigen::MatrixXd measured(50, 1);
    double place = 0.0;
    double speed = random.Normal() * 10.0;
    for (int i = 0; i < 50; ++i) {
      times_s.push_back(i);
      // Of two normal numbers, the position's and the speed's after one second (Wander).
      const double a = random.Normal();
      const double b = random.Normal();
      const double step = std::sqrt(kDensity / 3.0) * a;
      place += speed + step;
      speed += std::sqrt(kDensity) * (std::sqrt(0.75) * a + 0.5 * b);
      truth(i, 0) = place;
      measured(i, 0) = place + 3.0 * random.Normal();
    }
    const SmoothedMotion smoothed =
        SmoothMotion(times_s, measured, Eigen::VectorXd::Constant(50, 9.0), kDensity);
    for (int i = 0; i < 50; ++i) {
      const double error = smoothed.positions(i, 0) - truth(i, 0);
      squares += error * error / smoothed.variances[i];
      ++count;
    }
  }
  EXPECT_NEAR(squares / count, 1.0, 0.15);
}

}  // namespace
}  // namespace orbweave
