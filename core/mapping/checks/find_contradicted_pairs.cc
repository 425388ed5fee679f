// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/find_contradicted_pairs.h"

#include <bitset>
#include <cmath>
#include <utility>

#include "core/geometry/sphere_cells.h"
#include "core/mapping/checks/misleading_pairs.h"
#include "core/mapping/lengths/matches_in_planes.h"

namespace orbweave {
namespace {

// A wrong match falls within a few pixels of where the model wants it in fewer cases than this,
// even where everything lies along one street.
constexpr double kChance = 0.05;
constexpr double kDeviations = 4.0;
// Of a pair of images that stand right, however much else there is that moves or repeats. Of the
// matches that both show a point 38 % and more agreed in right models of rendered and real streets,
// 80 % and more where nothing repeats; in wrong ones, where houses repeat, up to 20 %.
constexpr double kExplainedShare = 1.0 / 3.0;
constexpr double kDeviationsBelow = 2.0;
// A cell is a sixteenth of the sphere, as in SupportOf: what fits into one or two is one thing.
constexpr int kBands = 4;
constexpr size_t kMinPlaces = 3;
// A pair without a point is asked by what its matches say alone: twice as many, as for a bridge.
constexpr int kMinInliersFactor = 2;

using Places = std::bitset<static_cast<size_t>(kBands* kBands)>;

/// Matches that can bear witness, and those of them that agree with the model.
struct PairEvidence {
  size_t asked = 0;
  size_t explained = 0;
  Places places_a{};  ///< of those that are not explained
  Places places_b{};

  void Count(bool is_explained, const Eigen::Vector3d& p_a, const Eigen::Vector3d& p_b) {
    ++asked;
    explained += is_explained ? 1 : 0;
    if (is_explained) return;
    places_a.set(SphereCell(p_a, kBands));
    places_b.set(SphereCell(p_b, kBands));
  }
};

/// Of the matches whose features both show a point.
PairEvidence EvidenceOfPoints(const MappingState& state,
                              const LinkedPair& pair,
                              double tolerance_px) {
  const CorrespondenceGraph& graph = state.Graph();
  const auto explains = [&](PointIndex point, Node node) {
    return IsExplained(state, state.Point(point).position, node, tolerance_px);
  };
  PairEvidence evidence;
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node a = graph.node_of_feature[pair.a][match.a];
    const Node b = graph.node_of_feature[pair.b][match.b];
    const PointIndex point_a = state.PointOf(a);
    const PointIndex point_b = state.PointOf(b);
    if (point_a == kNoPoint || point_b == kNoPoint) continue;
    evidence.Count(point_a == point_b || explains(point_a, b) || explains(point_b, a),
                   graph.bearing_of_node[a],
                   graph.bearing_of_node[b]);
  }
  return evidence;
}

/// Of all matches, by the epipolar planes of the model's pose and by what lies in front of it.
PairEvidence EvidenceOfMatches(const MappingState& state,
                               const LinkedPair& pair,
                               double tolerance_px) {
  PairEvidence evidence;
  VisitMatches(state, pair, [&](const PosedMatch& match) {
    evidence.Count(match.Agrees(tolerance_px), match.in_a, match.in_b);
  });
  return evidence;
}

/// Of the pair's own matches, by the planes alone: wrong ones along the way, of one window and the
/// next, lie in them, too.
PairEvidence EvidenceOfPlanes(const MappingState& state,
                              const LinkedPair& pair,
                              double tolerance_px) {
  PairEvidence evidence;
  for (const PosedMatch& match : OwnMatches(state, pair, tolerance_px))
    evidence.Count(match.IsInPlanes(tolerance_px), match.in_a, match.in_b);
  return evidence;
}

/// More than `kDeviations` standard deviations above what a binomial distribution leads to expect.
bool IsBeyondChance(const PairEvidence& evidence) {
  const double expected = kChance * static_cast<double>(evidence.asked);
  const double deviation = std::sqrt(expected * (1.0 - kChance));
  return static_cast<double>(evidence.explained) > 1.0 + expected + kDeviations * deviation;
}

/// Clearly fewer than this share, which a right model explains.
bool IsShort(const PairEvidence& evidence, double share) {
  const double expected = share * static_cast<double>(evidence.asked);
  const double deviation = std::sqrt(expected * (1.0 - share));
  return static_cast<double>(evidence.explained) < expected - kDeviationsBelow * deviation;
}

bool IsExplained(const PairEvidence& evidence) {
  return IsBeyondChance(evidence) && static_cast<double>(evidence.explained) >=
                                         kExplainedShare * static_cast<double>(evidence.asked);
}

/// Whether `min_matches` or more speak, those against the model in several places of both images.
bool Speaks(const PairEvidence& evidence, int min_matches) {
  return evidence.asked >= static_cast<size_t>(min_matches) &&
         evidence.places_a.count() >= kMinPlaces && evidence.places_b.count() >= kMinPlaces;
}

/// Whether it speaks, and no more agrees with the model than chance leaves, or clearly fewer than a
/// right one explains.
bool IsAgainst(const PairEvidence& evidence, int min_matches) {
  return Speaks(evidence, min_matches) &&
         (!IsBeyondChance(evidence) || IsShort(evidence, kExplainedShare));
}

enum class Judgement : uint8_t { kNone, kExplained, kContradicted, kAskew };

Judgement JudgePair(const MappingState& state,
                    const LinkedPair& pair,
                    const MappingOptions& options) {
  const double tolerance_px = kMatchTolerance * options.max_error_px;
  const int min_matches = kMinInliersFactor * options.min_inliers;
  const bool is_general = state.Problem().pairs[pair.index].kind == TwoViewKind::kGeneral;
  const PairEvidence planes = EvidenceOfPlanes(state, pair, tolerance_px);
  if (Speaks(planes, min_matches) && IsShort(planes, kShareInPlanes)) return Judgement::kAskew;
  const PairEvidence points = EvidenceOfPoints(state, pair, tolerance_px);
  if (IsExplained(points)) return Judgement::kExplained;
  const bool is_against =
      IsAgainst(points, options.min_inliers) ||
      (is_general && IsAgainst(EvidenceOfMatches(state, pair, tolerance_px), min_matches));
  return is_against ? Judgement::kContradicted : Judgement::kNone;
}

}  // namespace

JudgedPairs JudgePairs(const MappingState& state, const MappingOptions& options) {
  const std::vector<LinkedPair>& pairs = state.Graph().pairs;
  JudgedPairs judged;
  std::vector<uint8_t> is_explained(pairs.size(), 0);
  std::vector<std::pair<uint32_t, Judgement>> against;
  for (uint32_t p = 0; p < pairs.size(); ++p) {
    const LinkedPair& pair = pairs[p];
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) continue;
    const Judgement judgement = JudgePair(state, pair, options);
    if (judgement == Judgement::kNone) continue;
    if (judgement != Judgement::kExplained) {
      against.emplace_back(p, judgement);
      continue;
    }
    is_explained[p] = 1;
    judged.explained.push_back(state.Problem().pairs[pair.index].pair);
  }
  const MisleadingPairs misleading(state, std::move(is_explained));
  for (const auto& [p, judgement] : against) {
    if (misleading.IsMisleading(p)) continue;
    const ImagePair& pair = state.Problem().pairs[pairs[p].index].pair;
    judged.contradicted.push_back(pair);
    if (judgement == Judgement::kAskew) judged.askew.push_back(pair);
  }
  return judged;
}

std::vector<ImagePair> FindContradictedPairs(const MappingState& state,
                                             const MappingOptions& options) {
  return JudgePairs(state, options).contradicted;
}

}  // namespace orbweave
