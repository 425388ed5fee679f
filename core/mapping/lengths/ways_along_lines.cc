// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/ways_along_lines.h"

#include <algorithm>
#include <utility>

#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/street_lines.h"

namespace orbweave {
namespace {

/// Of the way behind each place.
std::vector<std::vector<uint32_t>> PairsAcross(const MappingState& state,
                                               const RegisteredSequence& places) {
  std::vector<std::vector<uint32_t>> across(places.size());
  const std::vector<LinkedPair>& pairs = state.Graph().pairs;
  for (uint32_t p = 0; p < pairs.size(); ++p) {
    const auto [a, b] = std::pair(pairs[p].a, pairs[p].b);
    if (!state.IsRegistered(a) || !state.IsRegistered(b)) continue;
    if (places.LineOf(a) != places.LineOf(b)) continue;
    const auto [first, last] = std::minmax({places.PlaceOf(a), places.PlaceOf(b)});
    if (last - first > kReachAlongLine) continue;
    for (size_t place = first; place < last; ++place) across[place].push_back(p);
  }
  return across;
}

}  // namespace

std::vector<WayAlongLine> WaysAlongLines(const MappingState& state,
                                         const RegisteredSequence& places) {
  std::vector<std::vector<uint32_t>> across = PairsAcross(state, places);
  std::vector<WayAlongLine> ways;
  for (size_t place = 0; place + 1 < places.size(); ++place) {
    const ImageSlot image = places.At(place);
    const ImageSlot next = places.At(place + 1);
    if (places.LineOf(image) == places.LineOf(next))
      ways.push_back({image, next, std::move(across[place])});
  }
  return ways;
}

const LengthAgreement& AgreeingMatches::OfPair(uint32_t pair) {
  std::optional<LengthAgreement>& asked = of_pair_[pair];
  if (!asked) asked = AgreementOfMatches(state_, state_.Graph().pairs[pair], tolerance_px_);
  return *asked;
}

LengthAgreement AgreeingMatches::Across(const WayAlongLine& way) {
  LengthAgreement matches;
  for (const uint32_t pair : way.pairs) matches.Add(OfPair(pair));
  return matches;
}

}  // namespace orbweave
