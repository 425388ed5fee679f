// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

struct RegistrationLimits {
  double max_error_px = 4.0;
  int min_inliers = 20;
  double min_inlier_share = 0.25;   ///< of the features that correspond to a point
  bool heeds_pairs = true;          ///< where strong pairs contradict what P3P finds
  bool waits_for_gnss = true;       ///< what GNSS steps contradict is not registered
  bool propose_from_pairs = false;  ///< try EstimatePoseFromPairs where P3P finds nothing
};

/// How many points must agree with the pose of an image that sees `num_visible` of them.
[[nodiscard]] uint32_t NeededInliers(const RegistrationLimits& limits, uint32_t num_visible);

/// What stood against an image that enough points might have placed.
enum class RegistrationObstacle {
  kNone,
  kPairs,   ///< strong pairs contradict where points put it, and do not hold it by themselves
  kLength,  ///< its points do not tell how far it is from the others (IsLengthTold)
  kUnheld,  ///< pairs say in which direction it lies from others, not how far (IsHeldByPairs)
};

struct RegistrationAttempt {
  bool registered = false;
  bool waits = false;  ///< GNSS contradicts what was found: to be tried once more is known
  uint32_t num_visible = 0;
  uint32_t num_inliers = 0;
  RegistrationObstacle obstacle = RegistrationObstacle::kNone;
};

/// Absolute orientation of an unregistered image (paper 3.4): P3P with RANSAC over its scene
/// correspondences, refined. Registers it when enough points agree; with limits.propose_from_pairs
/// only where they tell how long the step is (IsLengthTold), but also when pairs with registered
/// images hold it (IsHeldByPairs). With limits.heeds_pairs a pose that a strong pair contradicts
/// gives way to what a pair proposes and neither pairs nor GNSS contradict, where points in more
/// places of the image agree with that, or else to what pairs and points together propose where
/// more of them agree with it; if too few do, the image waits. A pose that GNSS contradicts
/// (JudgeByGnss) gives way to one that it and some places of the image support; without such a one
/// the image waits, unless its own position alone may be wrong and limits.waits_for_gnss is false.
/// Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<RegistrationAttempt> RegisterImage(MappingState& state,
                                                                ImageSlot image,
                                                                const RegistrationLimits& limits,
                                                                const StageContext& context);

}  // namespace orbweave
