// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace orbweave {

/// Where something was at each time, from positions that are measured at some of them.
struct SmoothedMotion {
  Eigen::MatrixXd positions{};  ///< a row per time, a column per axis
  Eigen::MatrixXd speeds{};     ///< the same, per second
  Eigen::VectorXd variances{};  ///< per time: of each axis of the position
};

/// The best estimate of a motion whose speed wanders: white noise of acceleration with spectral
/// density q, so that the speed of an axis changes by sqrt(q dt) within dt (Rauch 1965).
///
/// `times_s` ascend, and may be equal; gaps count as 100 s at most. `measured` has a row per time;
/// `variances` of each of its axes, infinite where nothing is measured; one at least is finite.
/// Linear in the times.
[[nodiscard]] SmoothedMotion SmoothMotion(std::span<const double> times_s,
                                          const Eigen::MatrixXd& measured,
                                          const Eigen::VectorXd& variances,
                                          double density);

}  // namespace orbweave
