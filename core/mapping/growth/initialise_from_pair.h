// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Starts an empty state from one pair: the first camera at the origin, the second at distance one,
/// points from the matches, two-view adjustment, filtering. False, and the state is spoilt, when
/// the pair does not hold what it promised: fewer than options.min_inliers points or less than a
/// quarter of the matches remain, or their median error exceeds half of options.max_error_px.
[[nodiscard]] absl::StatusOr<bool> InitialiseFromPair(MappingState& state,
                                                      const LinkedPair& pair,
                                                      const MappingOptions& options,
                                                      const StageContext& context);

}  // namespace orbweave
