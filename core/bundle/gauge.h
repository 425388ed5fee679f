// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/bundle/bundle_problem.h"

namespace orbweave {

/// What is held so that the similarity in which bearings leave the world free cannot drift.
struct Gauge {
  /// Per pose: not a variable, because the caller fixed it or because it is the gauge's anchor.
  std::vector<uint8_t> pose_is_held{};
  /// The two poses whose distance is held; nullopt where something else carries the scale.
  std::optional<uint32_t> anchor{};
  std::optional<uint32_t> farthest{};
  /// What RestoreScale moves: the poses and points that bearings hold together, the anchor apart.
  std::vector<uint8_t> pose_scales{};
  std::vector<uint8_t> point_scales{};
};

/// Priors, fixed points and two fixed poses each carry the gauge. Otherwise the anchor is the fixed
/// pose, or the first pose that observes anything, and its distance to the farthest other observing
/// centre is held. No distance is held when all centres coincide.
[[nodiscard]] Gauge ChooseGauge(const BundleProblem& problem);

/// Scales what is observed about the anchor until the held distance is `distance` again. Bearings,
/// and so the cost, do not notice. No-op unless the gauge holds a distance.
void RestoreScale(const Gauge& gauge, double distance, BundleProblem& problem);

/// Scales what is observed about the anchor. No-op for a scale of 1.
void ScaleAboutAnchor(const Gauge& gauge, double scale, BundleProblem& problem);

/// The held distance as it is now, 0 when none is held.
[[nodiscard]] double HeldDistance(const Gauge& gauge, const BundleProblem& problem);

}  // namespace orbweave
