// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/check_against_pairs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/quantile.h"
#include "core/graph/disjoint_sets.h"
#include "core/mapping/lengths/matches_in_planes.h"
#include "core/mapping/model/reconstructed_share.h"
#include "core/mapping/positioning/position_agreement.h"
#include "core/mapping/registration/register_image.h"

namespace orbweave {
namespace {

constexpr double kMinAgreeingMatches = 0.5;
constexpr double kErrorFloorPx = 0.1;
constexpr double kMinAgreeingPositions = 0.9;

std::vector<LinkedPair> RegisteredPairs(const MappingState& state) {
  std::vector<LinkedPair> pairs;
  for (const LinkedPair& pair : state.Graph().pairs) {
    if (state.IsRegistered(pair.a) && state.IsRegistered(pair.b)) pairs.push_back(pair);
  }
  return pairs;
}

bool Agrees(const MappingState& state, const LinkedPair& pair, double max_error_px) {
  size_t agreeing = 0;
  VisitMatches(state, pair, [&](const PosedMatch& match) {
    agreeing += match.Agrees(max_error_px) ? 1 : 0;
  });
  return static_cast<double>(agreeing) >=
         kMinAgreeingMatches *
             static_cast<double>(state.Problem().pairs[pair.index].inliers.size());
}

double JoinedShare(const MappingState& state, const std::vector<LinkedPair>& pairs) {
  DisjointSets sets(state.Graph().NumImages());
  for (const LinkedPair& pair : pairs) {
    if (ReconstructedShare(state, pair) >= RegistrationLimits{}.min_inlier_share) {
      sets.Unite(pair.a, pair.b);
    }
  }
  uint32_t largest = 0;
  for (const ImageSlot image : state.Registered()) largest = std::max(largest, sets.SizeOf(image));
  return static_cast<double>(largest) / static_cast<double>(state.Registered().size());
}

/// Median error per registered image, pixels at the equator.
std::vector<double> ImageMedians(const MappingState& state) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<double> medians;
  for (const ImageSlot image : state.Registered()) {
    std::vector<double> errors_px;
    for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
      const PointIndex point = state.PointOf(node);
      if (point == kNoPoint) continue;
      errors_px.push_back(NodeError(state, state.Point(point).position, node) /
                          AngleFromPixels(state, node, 1.0));
    }
    if (!errors_px.empty()) medians.push_back(std::max(kErrorFloorPx, UpperMedian(errors_px)));
  }
  return medians;
}

std::string Percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

}  // namespace

PairCheck CheckAgainstPairs(const MappingState& state, const MappingOptions& options) {
  PairCheck check;
  const std::vector<LinkedPair> pairs = RegisteredPairs(state);
  double all = 0.0;
  for (const LinkedPair& pair : pairs) {
    if (state.Problem().pairs[pair.index].kind == TwoViewKind::kPureRotation) continue;
    const auto matches = static_cast<double>(state.Problem().pairs[pair.index].inliers.size());
    all += matches;
    check.explained_share += matches * ReconstructedShare(state, pair);
    if (Agrees(state, pair, options.max_error_px)) check.agreeing_share += matches;
  }
  if (all == 0.0) return check;
  check.explained_share /= all;
  check.agreeing_share /= all;
  check.joined_share = JoinedShare(state, pairs);
  check.is_joined_by_positions =
      state.IsInEnu() && AgreementWithPositions(state).value_or(0.0) >= kMinAgreeingPositions;
  const std::vector<double> medians = ImageMedians(state);
  if (!medians.empty()) {
    check.worst_image_ratio =
        *std::max_element(medians.begin(), medians.end()) / UpperMedian(medians);
  }
  return check;
}

std::string TearOf(const PairCheck& check) {
  if (check.joined_share == 1.0 || check.is_joined_by_positions) return "";
  return "only " + Percent(check.joined_share) + " of its images are joined by common points";
}

std::string FaultOf(const PairCheck& check) {
  constexpr double kMinAgreeing = 0.8;
  constexpr double kMinExplained = 0.3;
  constexpr double kMaxImageRatio = 3.0;
  if (check.agreeing_share < kMinAgreeing) {
    return "only " + Percent(check.agreeing_share) + " of the matches are in pairs that agree";
  }
  if (check.explained_share < kMinExplained) {
    return "only " + Percent(check.explained_share) + " of the matches are explained";
  }
  if (std::string tear = TearOf(check); !tear.empty()) return tear;
  if (check.worst_image_ratio > kMaxImageRatio) {
    return "an image's errors are " + std::to_string(std::lround(check.worst_image_ratio)) +
           " times those of the others";
  }
  return "";
}

}  // namespace orbweave
