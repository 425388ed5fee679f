// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_that_pairs_hold.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/graph/disjoint_sets.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/lengths/ways_along_lines.h"
#include "core/mapping/registration/pair_witness.h"

namespace orbweave {
namespace {

/// A general pair of registered images, and how far the model agrees with it.
struct AskedPair {
  ImageSlot a = 0;
  ImageSlot b = 0;
  LengthAgreement matches{};
};

/// Unites the images of each line but across ways whose sides stand askew.
void UniteAlongLines(const MappingState& state,
                     const RegisteredSequence& places,
                     double tolerance_px,
                     DisjointSets& parts) {
  for (const WayAlongLine& way : WaysAlongLines(state, places)) {
    if (!IsAskew(MatchesAcross(state, way, tolerance_px))) parts.Unite(way.image, way.next);
  }
}

/// Unites the images of pairs of two lines that hold them together; returns the other pairs.
std::vector<AskedPair> UniteLines(const MappingState& state,
                                  const RegisteredSequence& places,
                                  double tolerance_px,
                                  int min_inliers,
                                  DisjointSets& parts) {
  std::vector<AskedPair> others;
  for (const LinkedPair& pair : state.Graph().pairs) {
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) continue;
    const LengthAgreement matches = AgreementOfMatches(state, pair, tolerance_px);
    const bool holds =
        matches.told == 0.0 ||
        (matches.agreeing >= min_inliers && matches.agreeing > kAgreeingPairShare * matches.told);
    if (holds && places.LineOf(pair.a) != places.LineOf(pair.b)) {
      parts.Unite(pair.a, pair.b);
    } else {
      others.push_back({pair.a, pair.b, matches});
    }
  }
  return others;
}

using MatchesBetween = std::map<std::pair<uint32_t, uint32_t>, LengthAgreement>;

MatchesBetween SumBetween(const std::vector<AskedPair>& pairs, DisjointSets& parts) {
  MatchesBetween between;
  for (const AskedPair& pair : pairs) {
    const auto sides = std::minmax({parts.Find(pair.a), parts.Find(pair.b)});
    if (sides.first != sides.second) between[sides].Add(pair.matches);
  }
  return between;
}

/// Unites parts whose pairs are not askew to each other; whether there were any.
bool UniteAlike(const MatchesBetween& between, DisjointSets& parts) {
  bool has_united = false;
  for (const auto& [sides, matches] : between) {
    if (!IsAskew(matches)) has_united |= parts.Unite(sides.first, sides.second);
  }
  return has_united;
}

}  // namespace

std::vector<std::vector<ImageSlot>> PartsThatPairsHold(const MappingState& state,
                                                       const MappingOptions& options) {
  DisjointSets sets(state.Graph().NumImages());
  const double tolerance_px = kMatchTolerance * options.max_error_px;
  const RegisteredSequence places(state, tolerance_px);
  UniteAlongLines(state, places, tolerance_px, sets);
  const std::vector<AskedPair> others =
      UniteLines(state, places, tolerance_px, options.min_inliers, sets);
  MatchesBetween between = SumBetween(others, sets);
  while (UniteAlike(between, sets)) between = SumBetween(others, sets);
  std::set<uint32_t> askew;
  for (const auto& [sides, matches] : between) askew.insert({sides.first, sides.second});
  std::vector<std::vector<ImageSlot>> parts = sets.SetsOf(state.Registered());
  for (const std::vector<ImageSlot>& part : parts) {
    if (!askew.contains(sets.Find(part.front()))) sets.Unite(part.front(), parts.front().front());
  }
  return sets.SetsOf(state.Registered());
}

}  // namespace orbweave
