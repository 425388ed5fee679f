// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/geometry/sim3.h"
#include "core/merging/georeference/drive_errors.h"
#include "core/merging/georeference/gnss_track.h"
#include "core/scene/cross_check.h"

namespace orbweave {

struct FoundDriveErrors {
  std::vector<DriveErrors> drives{};  ///< those of drives with errors, by number
  std::vector<CrossCheck> checks{};
};

/// Clock and lever arm: per drive a robust regression of GNSS minus model on velocity and on the
/// direction to the left of it, beside shift, turn and scale of that drive. Both are believed from
/// four deviations on (FitUncertainty::Bound), errors of neighbours taken as correlated as those of
/// all drives together or of their own say, whichever claims less (EstimateCorrelatedNoise);
/// a clock between three and four that matters is left as it is, and its sigma is what it may be:
/// hypot(estimate, sigma), which the centres' covariances allow for (CovariancesOfErrors). Of
/// neither is known what a single position tells more of than all others. A shift
/// along a street that goes one way at one speed, or along a circle, is not to be told from an
/// offset or a turn of all positions, and the check says so ("gnss_clock", "gnss_lever_arm").
///
/// Datum: drives whose positions are all off by more than receivers are, against each other. Where
/// more than half of the drives agree, the others are corrected ("gnss_datum", good); else nobody
/// can tell who is right, and the drives with most positions are followed (doubtful).
///
/// `enu_from_world` fits the positions to the model robustly. Linear in the fixes.
[[nodiscard]] FoundDriveErrors FindDriveErrors(std::span<const GnssDrive> drives,
                                               const Sim3& enu_from_world);

}  // namespace orbweave
