// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/mapping/lengths/pair_length.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// By how many thresholds of an observation matches are judged: both features may be off by one.
inline constexpr double kMatchTolerance = 2.0;

/// Calls visit(agrees, bearing in a, bearing in b) for each match of a pair of registered images:
/// it agrees when it lies within `tolerance_px` of the epipolar planes of the model's pose, and in
/// front of both images. Pairs of one centre have no such planes.
void VisitMatches(
    const MappingState& state,
    const LinkedPair& pair,
    double tolerance_px,
    const std::function<void(bool, const Eigen::Vector3d&, const Eigen::Vector3d&)>& visit);

/// How many of its matches agree, of kMaxRaysOfPair at most. Nothing is told by a pair that is not
/// general, or not of registered images.
[[nodiscard]] LengthAgreement AgreementOfMatches(const MappingState& state,
                                                 const LinkedPair& pair,
                                                 double tolerance_px);

/// The sum over all pairs of what agrees.
[[nodiscard]] double CountMatchesInPlanes(const MappingState& state, double tolerance_px);

}  // namespace orbweave
