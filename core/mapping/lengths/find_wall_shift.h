// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/gap_votes.h"

namespace orbweave {

/// Votes by the half of the sphere that their rays point to: the halves meet in a plane through the
/// way, and part the rays where they are most: along a street its two walls. The normal of the
/// plane is the main axis of the rays' azimuths about the way, half the argument of the sum of
/// exp(2 i azimuth) (axial data: Mardia and Jupp 2000), with z the ray across the way: exp(2 i
/// azimuth) = z^2 / |z|^2.
[[nodiscard]] std::array<std::vector<LengthVote>, 2> SplitByWalls(
    const MappingState& state, const GapVotes& gap, std::span<const LengthVote> votes);

/// Of the two walls of a street that one which more clearly says another length of a way than the
/// model has (IsToldByWall), by the rays of both sides of the way: how far what lies behind is to
/// be shifted, and how many say so. All 0 where neither does, or tells too little (TellEnough).
///
/// Where a house is the same as the next one its wall has thousands of matches between the house
/// that faces a panorama and the one that faces the next, as of one that stands far behind the
/// street. They agree with each other, outnumber those of the other wall by eight to one, and drag
/// the panorama along. In a rendered street 8 m apart without GNSS no length had clearly more rays
/// than the one that was 16 % too long; of the other wall 102 said that it is shorter, and 75 that
/// it is right.
///
/// Only lengths up to 35 % off are heard: those that a fooled wall has may be any, and what both
/// walls have wrong FindGapShift tells.
[[nodiscard]] GapShift FindWallShift(const AskedRays& asked, const GapVotes& gap);

}  // namespace orbweave
