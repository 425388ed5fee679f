// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/ask_gnss_of_ways.h"

#include <algorithm>
#include <cmath>

#include "core/mapping/lengths/find_gap_shift.h"
#include "core/mapping/lengths/log_length_of_pair.h"

namespace orbweave {
namespace {

constexpr double kWithinSigmas = 2.0;
constexpr double kOffBySigmas = 3.0;
constexpr double kKnownShare = 0.2;
constexpr double kRoughlyKnownShare = 0.4;
constexpr double kWithinRoughSigmas = 1.0;
constexpr auto kFewestRays = static_cast<double>(kFewestRaysOfPair);

}  // namespace

std::vector<double> ShiftsByGnss(const AskedRays& asked, const GapVotes& gap, const GnssWay& way) {
  const double wanted = -way.Misfit(asked.state) * way.sigma;
  const double allowed = kWithinSigmas * way.sigma;
  std::vector<double> shifts;
  double here = 0.0;
  for (const std::vector<LengthVote>* votes : {&gap.before, &gap.behind}) {
    const GapShift shift =
        FindGapShiftWithin(asked, gap, *votes, wanted - allowed, wanted + allowed);
    here = std::max(here, shift.here);
    if (shift.elsewhere >= kFewestRays) shifts.push_back(shift.shift);
  }
  if (here < kFewestRays && shifts.empty()) shifts.push_back(wanted);
  return shifts;
}

bool IsBorneOut(const AskedRays& asked,
                const GapVotes& gap,
                const GnssWays& gnss,
                const WishOfRays& wish) {
  const GnssWay* const way = gnss.WayToNext(gap.image, gap.next);
  if (way == nullptr) return false;
  const double misfit = way->Misfit(asked.state);
  const bool is_refuted = std::abs(misfit + wish.elsewhere / way->sigma) > kOffBySigmas;
  if (wish.elsewhere != 0.0 && !is_refuted) return false;
  const auto has_it = [&](double known_share, double sigmas) {
    return way->sigma <= known_share * way->length && std::abs(misfit) <= sigmas;
  };
  return has_it(kKnownShare, kWithinSigmas) ||
         (wish.here >= 2.0 * kFewestRays && has_it(kRoughlyKnownShare, kWithinRoughSigmas));
}

}  // namespace orbweave
