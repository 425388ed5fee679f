// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/scene/cross_check.h"

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

struct FoundDriveErrors {
  std::vector<DriveErrors> drives{};  ///< those of drives with errors, by number
  std::vector<CrossCheck> checks{};
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

/// Clock and lever arm: per drive a robust regression of GNSS minus model on velocity and on the
/// direction to the left of it, beside shift, turn and scale of that drive. Both are believed from
/// four deviations on (FitUncertainty::Bound), errors of neighbours taken as correlated as those of
/// all drives together or of their own say, whichever claims less (EstimateCorrelatedNoise);
/// a clock between three and four that matters is doubtful. A shift along a street that goes one
/// way at one speed, or along a circle, is not to be told from an offset or a turn of all
/// positions, and the check says so ("gnss_clock", "gnss_lever_arm").
///
/// Datum: drives whose positions are all off by more than receivers are, against each other. Where
/// more than half of the drives agree, the others are corrected ("gnss_datum", good); else nobody
/// can tell who is right, and the drives with most positions are followed (doubtful).
///
/// `enu_from_world` fits the positions to the model robustly. Linear in the fixes.
[[nodiscard]] FoundDriveErrors FindDriveErrors(std::span<const GnssDrive> drives,
                                               const Sim3& enu_from_world);

}  // namespace orbweave
