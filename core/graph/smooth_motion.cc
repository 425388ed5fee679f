// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/smooth_motion.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace orbweave {
namespace {

// Before anything is measured, per axis.
constexpr double kUnknownPosition_m = 1e5;
constexpr double kUnknownSpeed_m_s = 1e3;
constexpr double kMaxGap_s = 100.0;

/// Position and speed, a column per axis; all axes are known equally well.
struct MotionState {
  Eigen::Matrix<double, 2, Eigen::Dynamic> mean{};
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

Eigen::Matrix2d Transition(double dt_s) { return (Eigen::Matrix2d() << 1, dt_s, 0, 1).finished(); }

Eigen::Matrix2d Wander(double dt_s, double density) {
  const double square = dt_s * dt_s;
  return density *
         (Eigen::Matrix2d() << square * dt_s / 3.0, square / 2.0, square / 2.0, dt_s).finished();
}

MotionState Predict(const MotionState& state, double dt_s, double density) {
  const Eigen::Matrix2d transition = Transition(dt_s);
  return {
      .mean = transition * state.mean,
      .covariance = transition * state.covariance * transition.transpose() + Wander(dt_s, density)};
}

void Update(const Eigen::RowVectorXd& measured, double variance, MotionState& state) {
  if (!std::isfinite(variance)) return;
  const Eigen::Vector2d gain = state.covariance.col(0) / (state.covariance(0, 0) + variance);
  state.mean += gain * (measured - state.mean.row(0));
  // Joseph's form, which keeps the covariance positive.
  Eigen::Matrix2d kept = Eigen::Matrix2d::Identity();
  kept.col(0) -= gain;
  state.covariance =
      kept * state.covariance * kept.transpose() + variance * gain * gain.transpose();
}

/// What is known at `filtered`, once the next is known to be `next` where `predicted` was expected.
MotionState Smooth(const MotionState& filtered,
                   const MotionState& predicted,
                   const MotionState& next,
                   double dt_s) {
  const Eigen::Matrix2d gain =
      filtered.covariance * Transition(dt_s).transpose() * predicted.covariance.inverse();
  return {.mean = filtered.mean + gain * (next.mean - predicted.mean),
          .covariance = filtered.covariance +
                        gain * (next.covariance - predicted.covariance) * gain.transpose()};
}

}  // namespace

SmoothedMotion SmoothMotion(std::span<const double> times_s,
                            const Eigen::MatrixXd& measured,
                            const Eigen::VectorXd& variances,
                            double density) {
  const auto size = static_cast<Eigen::Index>(times_s.size());
  const auto gap_s = [&](Eigen::Index i) {
    const auto at = static_cast<size_t>(i);
    return std::min(times_s[at] - times_s[at - 1], kMaxGap_s);
  };
  std::vector<MotionState> predicted(times_s.size());
  std::vector<MotionState> states(times_s.size());
  for (Eigen::Index i = 0; i < size; ++i) {
    const auto at = static_cast<size_t>(i);
    if (i > 0) {
      predicted[at] = Predict(states[at - 1], gap_s(i), density);
    } else {
      predicted[at].mean.setZero(2, measured.cols());
      predicted[at].covariance.diagonal() << kUnknownPosition_m * kUnknownPosition_m,
          kUnknownSpeed_m_s * kUnknownSpeed_m_s;
    }
    states[at] = predicted[at];
    Update(measured.row(i), variances[i], states[at]);
  }
  for (Eigen::Index i = size - 1; i > 0; --i) {
    const auto at = static_cast<size_t>(i);
    states[at - 1] = Smooth(states[at - 1], predicted[at], states[at], gap_s(i));
  }
  SmoothedMotion smoothed{.positions = Eigen::MatrixXd(size, measured.cols()),
                          .speeds = Eigen::MatrixXd(size, measured.cols()),
                          .variances = Eigen::VectorXd(size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    const MotionState& state = states[static_cast<size_t>(i)];
    smoothed.positions.row(i) = state.mean.row(0);
    smoothed.speeds.row(i) = state.mean.row(1);
    smoothed.variances[i] = state.covariance(0, 0);
  }
  return smoothed;
}

}  // namespace orbweave
