// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Follows the matches of each point's features, and of every feature so added, to free features of
/// registered images, and adds those within `max_error_px` of the point. Every step is checked
/// against the point, so one wrong match does not lead a track astray. Returns the number of
/// observations added.
uint32_t CompleteTracks(MappingState& state,
                        std::span<const PointIndex> points,
                        double max_error_px);

}  // namespace orbweave
