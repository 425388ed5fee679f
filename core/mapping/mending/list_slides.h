// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/lengths/gnss_ways.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/model/move_images.h"

namespace orbweave {

/// What would give ways to the next image the length that GNSS has them, where they are off
/// by more than two sigmas: along such a way, as far as most rays say that say what GNSS allows
/// within two sigmas (FindGapShiftWithin), or where rays say nothing of the way at all, as far as
/// GNSS has it: everything behind it; the piece to the next such way, and the one from the last
/// such way on, backwards; the image behind it alone, and the one before it alone, backwards. A
/// piece of few images that stands a house too far along agrees with itself and with many rays
/// across its ends, as houses repeat; those that are right are fewer, but there.
///
/// In order of the ways.
[[nodiscard]] std::vector<CandidateMove> ListSlides(const MappingState& state,
                                                    const MappingOptions& options,
                                                    const GnssWays& gnss);

}  // namespace orbweave
