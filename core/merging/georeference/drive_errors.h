// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/gnss_track.h"

namespace orbweave {

/// What all positions of a drive have wrong in common, as far as the model tells, to be taken off:
///   position = centre + ahead * travel + left_m * (unit vector left of travel) + offset_m.
struct DriveErrors {
  uint32_t drive = 0;
  bool has_times = false;  ///< then `ahead` is in seconds, and minus the delay of GNSS, else metres
  double ahead = 0.0;
  double left_m = 0.0;
  double ahead_sigma = 0.0;  ///< zero where it is not estimated
  double left_sigma_m = 0.0;
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();  ///< of a drive in another datum
};

/// Where GNSS would put the centre of `fix`, whose drive is wrong by `errors`: take it off its
/// position.
[[nodiscard]] Eigen::Vector3d ErrorAt(const DriveErrors& errors,
                                      const DrivenFix& fix,
                                      const Sim3& enu_from_world);

/// What not knowing `errors` exactly adds to the covariance of every centre of a frame that was
/// fitted without them: their effect on all positions goes into shift, turn and scale of the frame.
/// By position in `drives` and fix, for centres `at`, east-north-up metres like `drives`' centres.
[[nodiscard]] std::vector<Eigen::Matrix3d> CovariancesOfErrors(std::span<const DriveErrors> errors,
                                                               std::span<const GnssDrive> drives,
                                                               std::span<const Eigen::Vector3d> at);

}  // namespace orbweave
