// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/correlated_noise.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {

/// A robust regression of GNSS minus model along one drive, in the plane, on what all its positions
/// may have wrong in common (ErrorAt) beside shift, turn and scale of the drive:
///   position - centre = (east, north) + turn J at + stretch at + ahead travel + left (left of it)
/// with `at` from the middle of the drive over its extent, and J a quarter turn.
class DriveRegression {
 public:
  enum Unknown { kEast, kNorth, kTurn, kStretch, kAhead, kLeft, kNumUnknowns };

  struct Fit {
    Eigen::VectorXd solution{};  ///< metres, but `ahead` (DriveErrors); kNumUnknowns
    double scatter_m = 1.0;      ///< of one axis
    std::vector<size_t> kept{};  ///< positions that are not off (by more than 3.5 scatters)
    double kept_share = 1.0;     ///< of all
  };

  /// `drive` outlives this.
  DriveRegression(const GnssDrive& drive, const Sim3& enu_from_world);

  /// The unknowns in `free`, the others zero: Cauchy's weights at the scatter found tell which
  /// positions are off, and of the others are the least squares whose sigmas can be told.
  [[nodiscard]] Fit Solve(std::span<const int> free) const;

  /// What a fit leaves of the positions that it kept, over what they claim.
  [[nodiscard]] NoiseAxis NoiseOf(const Fit& fit) const;

  /// Of a carrier as usual, metres per unit of `ahead`.
  [[nodiscard]] double speed() const { return speed_; }

 private:
  using Row = Eigen::Matrix<double, 2, kNumUnknowns>;

  [[nodiscard]] std::vector<double> ErrorsOf(const Eigen::VectorXd& solution) const;
  [[nodiscard]] Eigen::VectorXd SolveWeighted(const std::vector<int>& free,
                                              const std::vector<double>& weights) const;

  const GnssDrive& drive_;
  std::vector<Row> rows_{};
  std::vector<Eigen::Vector2d> residuals_{};
  double claimed_m_ = 1.0;
  Eigen::Matrix<double, kNumUnknowns, 1> prior_{};
  double speed_ = 1.0;
};

/// How far the unknowns of a fit are known.
struct FitUncertainty {
  Eigen::VectorXd sigmas{};  ///< standard deviations of all unknowns, of Student's distribution
  double freedoms = 1.0;     ///< of it, nu
  /// Of what the measurements tell of each unknown, how much that one tells which tells most of it:
  /// with v = C e / (e^T C e) of the covariance C and its unit vector e, (x_i v)^2 over their sum.
  Eigen::VectorXd largest_shares{};

  /// What an unknown is as unlikely to be off by as a normal variable by so many sigmas: few
  /// measurements exceed their own sigmas often. Of Student's quantile, by Wallace's approximation
  /// (1959), t^2 = nu (exp(((8 nu + 3) / (8 nu + 1) deviations)^2 / nu) - 1).
  [[nodiscard]] double Bound(int unknown, double deviations) const;
};

/// Of a fit that left `axis`, with errors that hang together as `noise` of it has them: nu is count
/// over inflation, less the unknowns.
[[nodiscard]] FitUncertainty UncertaintyOf(const NoiseAxis& axis, const CorrelatedNoise& noise);

}  // namespace orbweave
