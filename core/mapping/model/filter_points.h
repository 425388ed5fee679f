// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/mapping/model/triangulate_tracks.h"

namespace orbweave {

/// Removes observations further than limits.max_error_px from their point (so also those whose
/// point lies behind the bearing), then points left with fewer than two observations or that are
/// not well seen (IsWellSeen, limits.min_angle_deg). Returns the number of observations removed.
uint32_t FilterPoints(MappingState& state,
                      std::span<const PointIndex> points,
                      const TrackLimits& limits);

/// Indices of all points that exist, ascending.
[[nodiscard]] std::vector<PointIndex> AllPoints(const MappingState& state);

}  // namespace orbweave
