// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

struct FilteredSubproblem {
  Subproblem subproblem{};
  uint32_t removed_observations = 0;  ///< those of removed tracks included
  uint32_t removed_tracks = 0;
};

/// Removes observations whose ray is more than max_error_px (at the equator of the image's camera,
/// (8)) from their bearing, and so those behind it; then tracks with fewer than two observations or
/// no two rays at min_angle_rad or more, or at a quarter of the median of all tracks where that is
/// less (AdaptToParallax), and those that one image alone would see from close up (kMaxRangeGap).
/// Of split tracks, which no subproblem sees whole, observations alone. What remains stays sorted.
[[nodiscard]] FilteredSubproblem FilterSubproblem(Subproblem subproblem,
                                                  double max_error_px,
                                                  double min_angle_rad);

}  // namespace orbweave
