// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/measure_gap_lengths.h"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "core/mapping/lengths/ask_gnss_of_ways.h"
#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/find_wall_shift.h"
#include "core/mapping/lengths/gap_votes.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/scale_jumps.h"

namespace orbweave {
namespace {

/// What one side of a gap says of it.
struct Side {
  GapLength length{};
  GapShift shift{};
};

Side SideOf(const GapVotes& gap, std::span<const LengthVote> votes, const AskedRays& asked) {
  std::map<uint32_t, RayCount> rays;
  for (const LengthVote& vote : votes)
    rays[vote.pair].Add(vote.log_length, asked.log_lengths[vote.pair], kLengthTolerance);
  const auto& images = asked.state.Problem().images;
  GapLength side{.between = {images[gap.image].id, images[gap.next].id}};
  for (const auto& [pair, count] : rays) {
    const LengthAgreement agreement = AgreementOf({count});
    side.pairs += agreement.told > 0.0 ? 1 : 0;
    side.agreement.Add(agreement);
  }
  return {side, FindGapShift(asked, gap, votes)};
}

bool IsContradicted(const GapShift& side) {
  return side.IsClear() || IsToldElsewhere(side.here, side.rival);
}

/// Whether rays of one side crowd at the model's length, and those of neither at another.
bool AreTold(const GapShift& before, const GapShift& behind) {
  return (before.IsHere() || behind.IsHere()) && !IsContradicted(before) && !IsContradicted(behind);
}

/// Whether one side is to be believed less: it tells too little, or agrees more.
bool TellsLess(const GapLength& one, const GapLength& other) {
  const bool is_enough = TellsEnough(one.agreement, one.pairs);
  if (is_enough != TellsEnough(other.agreement, other.pairs)) return !is_enough;
  return one.agreement.Share() > other.agreement.Share();
}

/// The shift that clearly more rays want, those of one wall where all want none.
WishOfRays WishOf(const GapShift& wants_another, const GapShift& wall) {
  if (wants_another.IsClear()) return {wants_another.here, wants_another.shift};
  return {wants_another.here, IsToldByWall(wall.here, wall.elsewhere) ? wall.shift : 0.0};
}

/// Whether more rays of the one side say another length; where that is alike, more rays at all.
bool WantsAnotherMore(const GapShift& one, const GapShift& other) {
  const auto wish = [](const GapShift& side) {
    return std::pair(DeviationsElsewhere(side.here, side.elsewhere), side.here);
  };
  return wish(one) > wish(other);
}

/// Inliers of the pair of two neighbours, where it is general.
uint32_t MatchesOfNeighbours(const MappingState& state, const GapVotes& gap) {
  for (const uint32_t p : gap.pairs) {
    const LinkedPair& pair = state.Graph().pairs[p];
    if (std::minmax(pair.a, pair.b) != std::minmax(gap.image, gap.next)) continue;
    const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
    if (geometry.kind == TwoViewKind::kGeneral)
      return static_cast<uint32_t>(geometry.inliers.size());
  }
  return 0;
}

}  // namespace

std::vector<GapLength> MeasureGapLengths(const AskedRays& asked, const GnssWays* gnss) {
  std::vector<GapLength> gaps;
  const std::map<ImageSlot, double> scale_jumps = MeasureScaleJumps(asked);
  AgreeingMatches matches(asked.state, kMatchTolerance * asked.max_error_px);
  for (const GapVotes& votes : CollectGapVotes(asked)) {
    const Side before = SideOf(votes, votes.before, asked);
    const Side behind = SideOf(votes, votes.behind, asked);
    const GapShift& wants_another =
        WantsAnotherMore(behind.shift, before.shift) ? behind.shift : before.shift;
    GapLength& gap =
        gaps.emplace_back(TellsLess(before.length, behind.length) ? behind.length : before.length);
    gap.here = wants_another.here;
    gap.elsewhere = wants_another.elsewhere;
    gap.matches = matches.Across(votes);
    gap.rays = std::max(votes.asked, MatchesOfNeighbours(asked.state, votes));
    gap.telling_rays = static_cast<uint32_t>(std::max(votes.before.size(), votes.behind.size()));
    const GapShift wall = FindWallShift(asked, votes);
    gap.wall = {.told = wall.here + wall.elsewhere, .agreeing = wall.here};
    const bool is_on_gnss =
        gnss != nullptr && IsBorneOut(asked, votes, *gnss, WishOf(wants_another, wall));
    gap.is_borne_out = is_on_gnss || (AreTold(before.shift, behind.shift) &&
                                      !IsToldByWall(wall.here, wall.elsewhere));
    gap.scale_jump = is_on_gnss ? 0.0 : scale_jumps.at(votes.image);
  }
  return gaps;
}

}  // namespace orbweave
