// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/mapping/mapping_state.h"

namespace orbweave {

/// Unregistered images in the order in which they should be tried: the visibility score of
/// VisibilityPyramid, then more visible points, then the smaller slot. `min_visible` per image:
/// images that see fewer points are left out.
[[nodiscard]] std::vector<ImageSlot> RankNextImages(const MappingState& state,
                                                    std::span<const uint32_t> min_visible);

}  // namespace orbweave
