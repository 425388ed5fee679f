// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Removes points that are nearer to one of `images` which sees them than a hundredth of the median
/// distance to all that it sees. Two panoramas that stand almost at the same place, as those of a
/// slow camera do, make such points of wrong matches: rays that miss each other by an error meet a
/// few of their tiny baselines away. Steps of an adjustment that are small for the scene are large
/// for these, so that they hold the two panoramas where they are. Returns the number of
/// observations removed.
uint32_t DropNearPoints(MappingState& state, std::span<const ImageSlot> images);

}  // namespace orbweave
