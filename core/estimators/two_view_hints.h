// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "core/estimators/match_evidence.h"
#include "core/scene/predicted_pose.h"
#include "core/scene/two_view_geometry.h"

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
  /// Whether refinement has not led away from what is predicted, if anything is: to what drives
  /// along, or the sky.
  [[nodiscard]] bool Allow(const TwoViewGeometry& geometry) const {
    return !predicted || (HasBaseline(geometry.kind) && predicted->AgreesWith(geometry.b_from_a));
  }
};

}  // namespace orbweave
