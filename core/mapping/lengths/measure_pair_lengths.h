// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// How far rays bear out the lengths of the model. A ray that is matched in pairs p and q has one
/// depth, s_p d_p = s_q d_q (AverageBaselines): with the model's length of q it says how long p is,
///
///   log s_p = log |C_q| + log d_q - log d_p,
///
/// the median over all q that share the ray. It agrees when the two logarithms are no further
/// apart than `tolerance`. This is no question of which tracks the model chose: where houses
/// repeat, tracks that jump from one to the next outnumber the right ones in some pairs, the model
/// follows them, and has no error to show for it. But rays that several pairs see cannot all be
/// fooled alike.
///
/// Pairs take part whose images are both registered, which have a general geometry, and with whose
/// rotation (10 degrees) and direction (60 degrees) the model agrees: others contradict it by
/// themselves (JudgePairs). A pair counts with 200 rays at most. In order of the graph's pairs.
[[nodiscard]] std::vector<PairLength> MeasurePairLengths(const AskedRays& asked,
                                                         double tolerance = kLengthTolerance);

/// FindLengthFaults of the model: MeasurePairLengths and MeasureGapLengths.
[[nodiscard]] std::vector<LengthFault> FindLengthFaults(const MappingState& state,
                                                        const MappingOptions& options);

/// Rays of all pairs that agree closely (kCloseTolerance) with the model's lengths, 200 of each
/// pair at most. Pairs that do not take part have none: a model that is folded onto itself pays for
/// every pair that it contradicts.
[[nodiscard]] double CountAgreeingRays(const MappingState& state, const MappingOptions& options);

}  // namespace orbweave
