// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/ids.h"
#include "core/scene/predicted_pose.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// log10 of the false alarms to be expected of a pair that needs no second look. Some of the
/// features may miss what all would show. Where the largest of a town had this much evidence, one
/// pair of 33 was more than 3 degrees off that by all features (5); from 10^-50 on 5 of 83 were
/// (12), and from 10^-12 on 12 of 100, one turned round.
inline constexpr double kNoDoubt = -120.0;

/// Pairs that may see the same, by when they are matched. Every list is sorted, none has a pair of
/// another.
struct PairCandidates {
  std::vector<ImagePair> first{};    ///< the nearest of every image
  std::vector<ImagePair> second{};   ///< after them, but where these make it needless
  std::vector<ImagePair> reserve{};  ///< only of images that all others leave thinly connected
};

/// What is known of a verified pair without its matches.
struct MatchedPair {
  ImagePair pair{};
  TwoViewKind kind = TwoViewKind::kNone;
  uint32_t num_moved = 0;  ///< inliers that moved by more than a rotation explains
  double log10_false_alarms = 0.0;
  MatchRung rung = MatchRung::kDescriptors;
  Rigid3 b_from_a{};  ///< as of TwoViewGeometry
};

/// Whether a pair needs no second look. Predictions fit wrong planes of a facade that repeats: what
/// they add is no evidence beyond doubt.
[[nodiscard]] inline bool IsBeyondDoubt(const MatchedPair& pair) {
  return pair.rung != MatchRung::kGuided && pair.log10_false_alarms <= kNoDoubt;
}

/// What to match beside the first pairs, as far as that is decided. Lists are sorted.
struct WiderPairs {
  /// All pairs by features of facade views too: the panoramas' own have shown too few.
  bool wants_facades = false;
  /// 1: about the second ones; 2: about the reserve too; 3: about those to match again.
  uint32_t decisions = 0;
  std::vector<ImagePair> second{};         ///< of PairCandidates::second
  std::vector<ImagePair> reserve{};        ///< of PairCandidates::reserve, or held back before
  std::vector<PredictedPair> predicted{};  ///< of all that were matched and not verified
  uint32_t num_held_back = 0;              ///< second ones between images that a strong chain joins
  uint32_t num_thin_images = 0;            ///< those that `reserve` is for
};

}  // namespace orbweave
