// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Unregistered images in the order in which they should be tried: by the square of the number of
/// visible points times the score of VisibilityPyramid, then the smaller slot. On a sphere a
/// hundred points reach nearly every cell, so that the score alone would take a look-alike of a
/// registered place, which sees few points from the same spot, before a neighbour. `min_visible`
/// per image: images that see fewer points are left out. `by_score_alone`: without the number, as
/// the paper has it.
[[nodiscard]] std::vector<ImageSlot> RankNextImages(const MappingState& state,
                                                    std::span<const uint32_t> min_visible,
                                                    bool by_score_alone = false);

}  // namespace orbweave
