// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/lengths/asked_rays.h"
#include "core/mapping/lengths/gap_votes.h"
#include "core/mapping/lengths/gnss_ways.h"
#include "core/mapping/lengths/pair_length.h"

namespace orbweave {

/// How far rays bear out the way from each registered image of a line to the next, by what lies on
/// one side of it (CollectGapVotes), and whether they say that it has another length.
///
/// Of the two sides the agreement of that one is returned that agrees less, if it tells enough
/// (TellsEnough): where the scale jumps, what is behind agrees with itself, and what is before does
/// not. Another length is that of the side which more clearly wants one (FindGapShift).
///
/// Of lines in order, of images along them (RegisteredSequence).
/// `gnss`: tells which are borne out; none is without.
[[nodiscard]] std::vector<GapLength> MeasureGapLengths(const AskedRays& asked,
                                                       const GnssWays* gnss = nullptr);

/// Matches of the pairs that lead across, and those that agree (GapLength::matches).
[[nodiscard]] LengthAgreement MatchesAcross(const AskedRays& asked, const GapVotes& gap);

}  // namespace orbweave
