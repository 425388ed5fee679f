// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/georeference/drive_regression.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/quantile.h"
#include "core/merging/georeference/drive_errors.h"

namespace orbweave {
namespace {

constexpr int kReweightings = 10;
constexpr double kMedianOfRayleigh = 1.1774;
constexpr double kOff = 3.5;  // scatters; one in 450 of Rayleigh's lies beyond
// Sigma of shifts and errors before anything is measured: no receiver is worse.
constexpr double kAnything_m = 1000.0;

// Student's variance is finite from here on.
constexpr double kFewestFreedoms = 2.5;

double VarianceOf(const NoiseAxis& axis) {
  double squares = 0.0;
  for (const NoiseRun& run : axis.runs) squares += run.residuals.squaredNorm();
  return squares / std::max(static_cast<double>(axis.Count() - DriveRegression::kNumUnknowns), 1.0);
}

// FitUncertainty::largest_shares. Runs are axes of the same measurements.
Eigen::VectorXd LargestShares(const NoiseAxis& axis, const Eigen::MatrixXd& covariance) {
  const Eigen::MatrixXd ways = covariance * covariance.diagonal().cwiseInverse().asDiagonal();
  Eigen::MatrixXd told = Eigen::MatrixXd::Zero(axis.runs.front().design.rows(), ways.cols());
  for (const NoiseRun& run : axis.runs) told += (run.design * ways).cwiseAbs2();
  return told.colwise().maxCoeff().cwiseQuotient(told.colwise().sum()).transpose();
}

}  // namespace

DriveRegression::DriveRegression(const GnssDrive& drive, const Sim3& enu_from_world)
    : drive_(drive) {
  std::vector<Eigen::Vector2d> centres;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const DrivenFix& fix : drive.fixes) {
    centres.emplace_back((enu_from_world * fix.centre_in_world).head<2>());
    middle += centres.back() / static_cast<double>(drive.fixes.size());
  }
  double squares = 0.0;
  for (const Eigen::Vector2d& centre : centres) squares += (centre - middle).squaredNorm();
  const double extent_m = std::max(std::sqrt(squares / static_cast<double>(centres.size())), 1e-6);
  const DriveErrors ahead{.has_times = drive.has_times, .ahead = 1.0};
  const DriveErrors left{.has_times = drive.has_times, .left_m = 1.0};
  std::vector<double> speeds;
  std::vector<double> claimed_m;
  for (size_t i = 0; i < centres.size(); ++i) {
    const DrivenFix& fix = drive.fixes[i];
    const Eigen::Vector2d at = (centres[i] - middle) / extent_m;
    const Eigen::Vector2d by_ahead = ErrorAt(ahead, fix, enu_from_world).head<2>();
    const Eigen::Vector2d by_left = ErrorAt(left, fix, enu_from_world).head<2>();
    rows_.emplace_back() << 1.0, 0.0, -at.y(), at.x(), by_ahead.x(), by_left.x(),  //
        0.0, 1.0, at.x(), at.y(), by_ahead.y(), by_left.y();
    residuals_.emplace_back(fix.position_in_enu.head<2>() - centres[i]);
    speeds.push_back(by_ahead.norm());
    claimed_m.push_back(fix.horizontal_sigma_m);
  }
  claimed_m_ = Quantile(std::move(claimed_m), 0.5);
  speed_ = std::max(Quantile(std::move(speeds), 0.5), 1e-9);
  prior_.setConstant(1.0 / (kAnything_m * kAnything_m));
  prior_[kAhead] *= speed_ * speed_;
}

DriveRegression::Fit DriveRegression::Solve(std::span<const int> free) const {
  const std::vector<int> unknowns(free.begin(), free.end());
  Fit fit{.solution = Eigen::VectorXd::Zero(kNumUnknowns)};
  std::vector<double> weights(rows_.size());
  for (int iteration = 0; iteration < kReweightings; ++iteration) {
    const std::vector<double> errors = ErrorsOf(fit.solution);
    fit.scatter_m = std::max(Quantile(errors, 0.5) / kMedianOfRayleigh, 1e-6);
    std::ranges::transform(errors, weights.begin(), [&](double error) {
      return 1.0 / (fit.scatter_m * fit.scatter_m + error * error);
    });
    fit.solution = SolveWeighted(unknowns, weights);
  }
  const std::vector<double> errors = ErrorsOf(fit.solution);
  for (size_t i = 0; i < rows_.size(); ++i) {
    const bool is_kept = errors[i] <= kOff * fit.scatter_m;
    if (is_kept) fit.kept.push_back(i);
    weights[i] = is_kept ? 1.0 / (fit.scatter_m * fit.scatter_m) : 0.0;
  }
  fit.solution = SolveWeighted(unknowns, weights);
  fit.kept_share = static_cast<double>(fit.kept.size()) / static_cast<double>(rows_.size());
  return fit;
}

NoiseAxis DriveRegression::NoiseOf(const Fit& fit) const {
  NoiseAxis noise;
  const auto m = static_cast<Eigen::Index>(fit.kept.size());
  for (const Eigen::Index axis : {0, 1}) {
    NoiseRun& run = noise.runs.emplace_back();
    run.design.resize(m, kNumUnknowns);
    run.residuals.resize(m);
    for (Eigen::Index j = 0; j < m; ++j) {
      const size_t i = fit.kept[static_cast<size_t>(j)];
      run.places.push_back(drive_.fixes[i].way);
      run.design.row(j) = rows_[i].row(axis) / claimed_m_;
      run.residuals[j] = (residuals_[i] - rows_[i] * fit.solution)[axis] / claimed_m_;
    }
  }
  noise.information = std::max(VarianceOf(noise), 1e-12) * prior_;
  return noise;
}

std::vector<double> DriveRegression::ErrorsOf(const Eigen::VectorXd& solution) const {
  std::vector<double> errors;
  for (size_t i = 0; i < rows_.size(); ++i)
    errors.push_back((residuals_[i] - rows_[i] * solution).norm());
  return errors;
}

Eigen::VectorXd DriveRegression::SolveWeighted(const std::vector<int>& free,
                                               const std::vector<double>& weights) const {
  Eigen::MatrixXd A = prior_.asDiagonal();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(kNumUnknowns);
  for (size_t i = 0; i < rows_.size(); ++i) {
    A += weights[i] * rows_[i].transpose() * rows_[i];
    b += weights[i] * rows_[i].transpose() * residuals_[i];
  }
  const Eigen::MatrixXd A_free = A(free, free);
  const Eigen::VectorXd b_free = b(free);
  const Eigen::VectorXd found = A_free.ldlt().solve(b_free);
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(kNumUnknowns);
  solution(free) = found;
  return solution;
}

double FitUncertainty::Bound(int unknown, double deviations) const {
  const double normal = (8.0 * freedoms + 3.0) / (8.0 * freedoms + 1.0) * deviations;
  const double t = std::sqrt(freedoms * std::expm1(normal * normal / freedoms));
  return t * std::sqrt((freedoms - 2.0) / freedoms) * sigmas[unknown];
}

FitUncertainty UncertaintyOf(const NoiseAxis& axis, const CorrelatedNoise& noise) {
  const Eigen::Index p = axis.information.size();
  Eigen::MatrixXd A = axis.information.asDiagonal();
  for (const NoiseRun& run : axis.runs) A += run.design.transpose() * run.design;
  const double freedoms =
      std::max(static_cast<double>(axis.Count()) / noise.inflation - static_cast<double>(p),
               kFewestFreedoms);
  const double variance = VarianceOf(axis) * freedoms / (freedoms - 2.0);
  const Eigen::MatrixXd covariance = variance * A.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  return {.sigmas = covariance.diagonal().cwiseMax(0.0).cwiseProduct(noise.inflations).cwiseSqrt(),
          .freedoms = freedoms,
          .largest_shares = LargestShares(axis, covariance)};
}

}  // namespace orbweave
