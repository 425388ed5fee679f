// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// Points that two panoramas see on either side of a third one, and how many of them it sees too.
struct SeenBetween {
  ImageId image{};
  uint32_t asked = 0;
  uint32_t seen = 0;
};

/// For each panorama of the subproblem that is asked anything, sorted. It is asked for a point
/// where two others see it from either side of where it does (StandsBetween). What both see it
/// should see, unless something stands in the way, or it stands elsewhere.
///
/// Of tracks that the subproblem has for itself, 100,000 at most, evenly chosen. Time: these times
/// its panoramas.
[[nodiscard]] std::vector<SeenBetween> CountSeenBetween(const Subproblem& subproblem);

}  // namespace orbweave
