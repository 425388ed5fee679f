// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/cuts/parts_that_pairs_hold.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include "core/geometry/rotation.h"
#include "core/graph/disjoint_sets.h"
#include "core/mapping/checks/find_contradicted_pairs.h"
#include "core/mapping/lengths/find_length_faults.h"
#include "core/mapping/lengths/log_length_of_pair.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/lengths/ways_along_lines.h"
#include "core/mapping/registration/pair_witness.h"

namespace orbweave {
namespace {

/// Further off than a loop that does not close: such were 6 and 14 degrees.
constexpr double kElsewhereDeg = 20.0;

/// Whether a pair leads elsewhere than the model, or turns otherwise.
bool LeadsElsewhere(const MappingState& state, const LinkedPair& pair) {
  const TwoViewGeometry& geometry = state.Problem().pairs[pair.index];
  if (geometry.kind != TwoViewKind::kGeneral) return false;
  const Rigid3 b_from_a = PoseInModel(state, pair);
  const double off_rad = std::max(b_from_a.rotation.angularDistance(geometry.b_from_a.rotation),
                                  AngleBetween(b_from_a.Centre(), geometry.b_from_a.Centre()));
  return off_rad > kElsewhereDeg / 180.0 * std::numbers::pi;
}

/// What all pairs say of two sides that they join.
struct PairsBetween {
  LengthAgreement matches{};
  std::vector<uint32_t> pairs{};  ///< indices of the graph's
};

/// Whether pairs hold two sides together.
class Judge {
 public:
  Judge(const MappingState& state, const MappingOptions& options)
      : state_(state), options_(options) {}

  [[nodiscard]] bool HoldTogether(const PairsBetween& between) {
    return !IsAskew(between.matches) && !AreTorn(between);
  }
  /// Whether every pair contradicts the model and leads elsewhere: the sides are torn whatever
  /// holds them at another place.
  [[nodiscard]] bool AreTorn(const PairsBetween& between) {
    return !between.pairs.empty() && std::ranges::all_of(between.pairs, [&](uint32_t p) {
      return LeadsElsewhere(state_, state_.Graph().pairs[p]) && IsContradicted(p);
    });
  }

 private:
  /// All are judged once one is asked for: in a right model none is.
  bool IsContradicted(uint32_t p) {
    if (!contradicted_) {
      const std::vector<ImagePair> found = FindContradictedPairs(state_, options_);
      contradicted_.emplace(found.begin(), found.end());
    }
    return contradicted_->contains(state_.Problem().pairs[state_.Graph().pairs[p].index].pair);
  }

  const MappingState& state_;
  const MappingOptions& options_;
  std::optional<std::set<ImagePair>> contradicted_{};
};

/// Images by part.
class Parts {
 public:
  explicit Parts(uint32_t num_images) : sets_(num_images) {}

  [[nodiscard]] uint32_t PartOf(ImageSlot image) { return sets_.Find(image); }
  /// False when they were one already, or hold images that stay apart.
  bool Unite(ImageSlot a, ImageSlot b) {
    const auto sides = std::minmax({sets_.Find(a), sets_.Find(b)});
    const bool stay_apart = std::ranges::any_of(torn_, [&](const auto& ends) {
      return std::minmax({sets_.Find(ends.first), sets_.Find(ends.second)}) == sides;
    });
    return !stay_apart && sets_.Unite(a, b);
  }
  void KeepApart(ImageSlot a, ImageSlot b) { torn_.emplace_back(a, b); }
  [[nodiscard]] std::vector<std::vector<ImageSlot>> List(const MappingState& state) {
    return sets_.SetsOf(state.Registered());
  }

 private:
  DisjointSets sets_;
  std::vector<std::pair<ImageSlot, ImageSlot>> torn_{};
};

/// Unites the images of each line but across ways that pairs do not hold together.
void UniteAlongLines(const MappingState& state,
                     const RegisteredSequence& places,
                     AgreeingMatches& matches,
                     Judge& judge,
                     Parts& parts) {
  for (WayAlongLine& way : WaysAlongLines(state, places)) {
    const PairsBetween across{matches.Across(way), std::move(way.pairs)};
    if (judge.HoldTogether(across)) {
      parts.Unite(way.image, way.next);
    } else if (judge.AreTorn(across)) {
      parts.KeepApart(way.image, way.next);
    }
  }
}

/// Unites the images of pairs of two lines that hold them together; returns the other pairs of
/// registered images, as indices of the graph's.
std::vector<uint32_t> UniteLines(const MappingState& state,
                                 const RegisteredSequence& places,
                                 AgreeingMatches& matches,
                                 int min_inliers,
                                 Parts& parts) {
  std::vector<uint32_t> others;
  const std::vector<LinkedPair>& pairs = state.Graph().pairs;
  for (uint32_t p = 0; p < pairs.size(); ++p) {
    const LinkedPair& pair = pairs[p];
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) continue;
    const LengthAgreement& asked = matches.OfPair(p);
    const bool holds = asked.told == 0.0 || (asked.agreeing >= min_inliers &&
                                             asked.agreeing > kAgreeingPairShare * asked.told);
    if (holds && places.LineOf(pair.a) != places.LineOf(pair.b)) {
      parts.Unite(pair.a, pair.b);
    } else {
      others.push_back(p);
    }
  }
  return others;
}

using PairsOfParts = std::map<std::pair<uint32_t, uint32_t>, PairsBetween>;

PairsOfParts SumBetween(const MappingState& state,
                        const std::vector<uint32_t>& pairs,
                        AgreeingMatches& matches,
                        Parts& parts) {
  PairsOfParts sums;
  for (const uint32_t p : pairs) {
    const LinkedPair& pair = state.Graph().pairs[p];
    const auto sides = std::minmax({parts.PartOf(pair.a), parts.PartOf(pair.b)});
    if (sides.first == sides.second) continue;
    PairsBetween& between = sums[sides];
    between.matches.Add(matches.OfPair(p));
    between.pairs.push_back(p);
  }
  return sums;
}

/// Unites parts that pairs hold together; whether there were any.
bool UniteHeld(const PairsOfParts& sums, Judge& judge, Parts& parts) {
  bool has_united = false;
  for (const auto& [sides, between] : sums) {
    if (judge.HoldTogether(between)) has_united |= parts.Unite(sides.first, sides.second);
  }
  return has_united;
}

}  // namespace

std::vector<std::vector<ImageSlot>> PartsThatPairsHold(const MappingState& state,
                                                       const MappingOptions& options) {
  Parts parts(state.Graph().NumImages());
  const double tolerance_px = kMatchTolerance * options.max_error_px;
  const RegisteredSequence places(state, tolerance_px);
  Judge judge(state, options);
  AgreeingMatches matches(state, tolerance_px);
  UniteAlongLines(state, places, matches, judge, parts);
  const std::vector<uint32_t> others =
      UniteLines(state, places, matches, options.min_inliers, parts);
  PairsOfParts sums = SumBetween(state, others, matches, parts);
  while (UniteHeld(sums, judge, parts)) sums = SumBetween(state, others, matches, parts);
  std::set<uint32_t> askew;
  for (const auto& [sides, between] : sums) askew.insert({sides.first, sides.second});
  const std::vector<std::vector<ImageSlot>> listed = parts.List(state);
  for (const std::vector<ImageSlot>& part : listed) {
    if (!askew.contains(parts.PartOf(part.front())))
      parts.Unite(part.front(), listed.front().front());
  }
  return parts.List(state);
}

}  // namespace orbweave
