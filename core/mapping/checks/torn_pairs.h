// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Pairs that lead elsewhere than the model, or turn otherwise (JudgedPairs::askew), though their
/// images stand by each other in it, kReachAlongLine usual steps of the drives (UsualStep) or
/// places of one drive apart at most: panoramas see so much of each other's place. Two places that
/// look alike are not beside each other; so the model is torn between the two images, or the pair
/// is wrong in itself. Of models of a block of 60 panoramas of two days those that had not
/// closed, 3.6 to 8 m off in one step from the one day to the other, had three to five, right ones
/// none.
[[nodiscard]] std::vector<ImagePair> FindTornPairs(const MappingState& state,
                                                   const MappingOptions& options);

}  // namespace orbweave
