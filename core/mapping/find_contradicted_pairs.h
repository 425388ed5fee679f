// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Pairs of registered images whose verified matches the model tells apart: of the matches whose
/// two features both show a point, at least options.min_inliers, less than half show the same one.
/// Places that look alike make such pairs; in a model folded onto itself the right pairs are among
/// them. In order of the graph's pairs.
[[nodiscard]] std::vector<ImagePair> FindContradictedPairs(const MappingState& state,
                                                           const MappingOptions& options);

}  // namespace orbweave
