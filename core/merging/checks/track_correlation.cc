// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/checks/track_correlation.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

constexpr double kMinSquares = 500.0;  // redundancy: r is known to a few hundredths
constexpr double kMaxCorrelation = 0.9;
constexpr int kBisections = 30;

/// What residuals of unit errors come to, both coordinates together.
struct Expected {
  double products = 0.0;
  double squares = 0.0;
};

void AddCoordinate(const Eigen::MatrixXd& C, bool has_slope, Expected& expected) {
  const Eigen::Index n = C.rows();
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(n, n);
  P.array() -= 1.0 / static_cast<double>(n);
  if (has_slope) {
    const Eigen::VectorXd slope =
        Eigen::VectorXd::LinSpaced(
            n, -0.5 * static_cast<double>(n - 1), 0.5 * static_cast<double>(n - 1))
            .normalized();
    P -= slope * slope.transpose();
  }
  const Eigen::MatrixXd residuals = P * C * P;
  expected.products += residuals.diagonal(1).sum();
  expected.squares += residuals.trace();
}

Expected ExpectedOf(size_t images, double r) {
  const auto n = static_cast<Eigen::Index>(images);
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j)
      C(i, j) = i == j ? 1.0 : std::pow(r, static_cast<double>(std::abs(i - j)));
  }
  Expected expected;
  AddCoordinate(C, false, expected);
  AddCoordinate(C, true, expected);
  return expected;
}

}  // namespace

void TrackCorrelation::AddTrack(std::span<const Eigen::Vector3d> residuals) {
  const size_t n = residuals.size();
  if (n < 2 || n > kMaxImages) return;
  for (size_t i = 0; i < n; ++i) {
    squares[n] += residuals[i].squaredNorm();
    if (i > 0) products[n] += residuals[i - 1].dot(residuals[i]);
  }
  tracks[n] += 1.0;
}

void TrackCorrelation::Add(const TrackCorrelation& other) {
  for (size_t n = 0; n < kLengths; ++n) {
    products[n] += other.products[n];
    squares[n] += other.squares[n];
    tracks[n] += other.tracks[n];
  }
}

double TrackCorrelation::Correlation() const {
  double found = 0.0;
  double redundancy = 0.0;
  for (size_t n = kMinImages; n < kLengths; ++n) {
    found += products[n];
    redundancy += tracks[n] * (2.0 * static_cast<double>(n) - 3.0);
  }
  if (redundancy < kMinSquares) return 0.0;
  const auto excess = [&](double r) {
    double expected = 0.0;
    for (size_t n = kMinImages; n < kLengths; ++n) {
      if (tracks[n] == 0.0) continue;
      const Expected of_track = ExpectedOf(n, r);
      expected += squares[n] * of_track.products / of_track.squares;
    }
    return found - expected;
  };
  if (excess(0.0) <= 0.0) return 0.0;
  double low = 0.0;
  double high = kMaxCorrelation;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) > 0.0 ? low : high) = middle;
  }
  return low;
}

double TrackCorrelation::Inflation() const {
  const double r = Correlation();
  double independent = 0.0;
  double correlated = 0.0;
  for (size_t n = kMinImages; n < kLengths; ++n) {
    if (tracks[n] == 0.0) continue;
    independent += tracks[n] * (2.0 * static_cast<double>(n) - 3.0);
    correlated += tracks[n] * ExpectedOf(n, r).squares;
  }
  if (r == 0.0 || !(correlated > 0.0)) return 1.0;
  return std::max(independent / correlated, 1.0) * (1.0 + r) / (1.0 - r);
}

}  // namespace orbweave
