// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/find_contradicted_pairs.h"

#include <bitset>
#include <cmath>

#include "core/geometry/sphere_cells.h"

namespace orbweave {
namespace {

constexpr double kToleranceFactor = 2.0;  // both the point and the feature may be off by one
// A wrong match falls within a few pixels of where the model wants it in fewer cases than this,
// even where everything lies along one street.
constexpr double kChance = 0.05;
constexpr double kDeviations = 4.0;
// A cell is a sixteenth of the sphere, as in SupportOf: what fits into one or two is one thing.
constexpr int kBands = 4;
constexpr size_t kMinPlaces = 3;

using Places = std::bitset<static_cast<size_t>(kBands* kBands)>;

struct PairEvidence {
  size_t shown = 0;  ///< matches whose features both show a point
  size_t explained = 0;
  Places places_a{};  ///< of those that are not explained
  Places places_b{};
};

PairEvidence EvidenceOf(const MappingState& state, const LinkedPair& pair, double tolerance_px) {
  const CorrespondenceGraph& graph = state.Graph();
  const auto explains = [&](PointIndex point, Node node) {
    return NodeError(state, state.Point(point).position, node) <=
           AngleFromPixels(state, node, tolerance_px);
  };
  PairEvidence evidence;
  for (const FeatureMatch& match : state.Problem().pairs[pair.index].inliers) {
    const Node a = graph.node_of_feature[pair.a][match.a];
    const Node b = graph.node_of_feature[pair.b][match.b];
    const PointIndex point_a = state.PointOf(a);
    const PointIndex point_b = state.PointOf(b);
    if (point_a == kNoPoint || point_b == kNoPoint) continue;
    ++evidence.shown;
    if (point_a == point_b || explains(point_a, b) || explains(point_b, a)) {
      ++evidence.explained;
      continue;
    }
    evidence.places_a.set(SphereCell(graph.bearing_of_node[a], kBands));
    evidence.places_b.set(SphereCell(graph.bearing_of_node[b], kBands));
  }
  return evidence;
}

/// More than `kDeviations` standard deviations above what a binomial distribution leads to expect.
bool IsBeyondChance(const PairEvidence& evidence) {
  const double expected = kChance * static_cast<double>(evidence.shown);
  const double deviation = std::sqrt(expected * (1.0 - kChance));
  return static_cast<double>(evidence.explained) > 1.0 + expected + kDeviations * deviation;
}

}  // namespace

JudgedPairs JudgePairs(const MappingState& state, const MappingOptions& options) {
  JudgedPairs judged;
  for (const LinkedPair& pair : state.Graph().pairs) {
    if (!state.IsRegistered(pair.a) || !state.IsRegistered(pair.b)) continue;
    const PairEvidence evidence = EvidenceOf(state, pair, kToleranceFactor * options.max_error_px);
    const ImagePair ids = state.Problem().pairs[pair.index].pair;
    if (IsBeyondChance(evidence)) {
      judged.explained.push_back(ids);
    } else if (evidence.shown >= static_cast<size_t>(options.min_inliers) &&
               evidence.places_a.count() >= kMinPlaces && evidence.places_b.count() >= kMinPlaces) {
      judged.contradicted.push_back(ids);
    }
  }
  return judged;
}

std::vector<ImagePair> FindContradictedPairs(const MappingState& state,
                                             const MappingOptions& options) {
  return JudgePairs(state, options).contradicted;
}

}  // namespace orbweave
