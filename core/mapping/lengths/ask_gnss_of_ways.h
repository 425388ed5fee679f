// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/gap_votes.h"
#include "core/mapping/lengths/gnss_ways.h"

namespace orbweave {

/// How far what lies behind a way would have to be shifted along it to have the length that GNSS
/// says: as most rays of either side of it say that say what GNSS allows within two sigmas
/// (FindGapShiftWithin), eight at least; as far as GNSS has it where rays say nothing of the way
/// at all; none where they say what the model has and nothing that GNSS allows.
[[nodiscard]] std::vector<double> ShiftsByGnss(const AskedRays& asked,
                                               const GapVotes& gap,
                                               const GnssWay& way);

/// Whether GNSS knows a way to a fifth of its length, has it as it is up to two sigmas, and would
/// have it off by more than three if it were longer by `elsewhere`, the shift that clearly more
/// rays want, where that is not 0.
[[nodiscard]] bool IsBorneOut(const AskedRays& asked,
                              const GapVotes& gap,
                              const GnssWays& gnss,
                              double elsewhere);

}  // namespace orbweave
