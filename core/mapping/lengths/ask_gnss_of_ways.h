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

/// What rays say of a way: how many say closely what the model has, and the shift that clearly more
/// of them want, or 0 (FindGapShift).
struct WishOfRays {
  double here = 0.0;
  double elsewhere = 0.0;
};

/// Whether GNSS knows a way to a fifth of its length, has it as it is up to two sigmas, and would
/// have it off by more than three if it were longer by the shift that rays want, where they want
/// one. Where rays crowd at the model's length, those of two pairs at least (16), GNSS may know it
/// to two fifths, and has it up to one sigma: either way it is off by less than half a step, which
/// is as near as places that look alike usually are.
[[nodiscard]] bool IsBorneOut(const AskedRays& asked,
                              const GapVotes& gap,
                              const GnssWays& gnss,
                              const WishOfRays& wish);

}  // namespace orbweave
