// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace orbweave {

/// Errors of a receiver on a carrier that drives past houses.
struct GnssModel {
  double sigma_m = 2.0;        ///< horizontal noise per axis; 1.5 times that vertically
  double bias_m = 0.0;         ///< length of a constant horizontal offset of the drive
  double outlier_share = 0.0;  ///< share of positions that are 15 to 60 m off
  /// Standard deviation per horizontal axis, 1.5 times that vertically, of an error that stays
  /// while houses reflect the same satellites: its correlation between two positions of the way is
  /// exp(-distance / multipath_length_m) (a Gauss-Markov process).
  double multipath_m = 0.0;
  double multipath_length_m = 60.0;
};

/// One measured position per true one, east-north-up metres. Equal seeds give equal errors.
[[nodiscard]] std::vector<Eigen::Vector3d> SimulateGnss(const std::vector<Eigen::Vector3d>& truth,
                                                        const GnssModel& model,
                                                        uint64_t seed);

}  // namespace orbweave
