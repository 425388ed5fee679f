// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "core/estimators/match_evidence.h"
#include "core/scene/predicted_pose.h"

namespace orbweave {

/// Whether matches that come first are likelier to be right than those after them.
enum class MatchOrder { kUnknown, kBestFirst };

/// What is known of a pair beside its matches.
struct TwoViewHints {
  MatchOrder order = MatchOrder::kUnknown;
  /// With one, samples are of two matches, whatever the options say: the pose has this rotation and
  /// a baseline that leads between the two directions, as far as they are known (AgreesWith).
  std::optional<PredictedPose> predicted{};

  /// Matches that a pose is found from (EvidenceOf).
  [[nodiscard]] size_t Sample() const { return predicted ? kTurnedSample : kPoseSample; }
};

}  // namespace orbweave
