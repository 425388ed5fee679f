// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/estimators/match_evidence.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// The evidence (EvidenceOf) for a direction of the baseline that rivals the one of `geometry`,
/// with the same rotation and 15 degrees or more apart, of those of `matches` that moved by more
/// than errors and do not fit `geometry`; none where there is none. A facade whose windows repeat
/// has two directions, that to where the camera went and that with every window matched one
/// further on; which of them has more matches says nothing. A vehicle that drives along has its
/// own. With R known two matches fix the direction: it is at right angles to both (R a) x b.
/// `seed` seeds the sampler. Kinds with a baseline.
[[nodiscard]] MatchEvidence FindRivalDirection(std::span<const Eigen::Vector3d> bearings_a,
                                               std::span<const Eigen::Vector3d> bearings_b,
                                               std::span<const FeatureMatch> matches,
                                               const TwoViewGeometry& geometry,
                                               double max_error_rad,
                                               uint64_t seed);

}  // namespace orbweave
