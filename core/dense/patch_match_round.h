// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/dense/choose_views.h"
#include "core/dense/dense_options.h"
#include "core/dense/match_kernel.h"
#include "core/dense/match_scale.h"
#include "core/dense/noise_by_level.h"

namespace orbweave {

/// Ranges between which planes are looked for, along the ray.
struct RangeLimits {
  float min_m = 0.0F;
  float max_m = 0.0F;
};

/// What one round over a field tries at each pixel.
struct PatchMatchRound {
  int neighbours = 4;         ///< planes of the best of 8 regions around
  int fresh = 0;              ///< random planes
  bool level = false;         ///< the level plane through what it holds
  int perturbed = 2;          ///< random changes of what it holds
  float step_px = 1.0F;       ///< largest change of depth, in pixels of parallax
  float refine_px = 0.0F;     ///< tries so much nearer and farther, moves to the minimum; 0: not
  bool frees_slopes = false;  ///< sigmas count that slopes are not known (FreeSlopeVariance)
  bool views_changed = true;  ///< costs of held planes are those of other sources
  float tilt = 0.3F;          ///< largest change of the normal, radians
  uint32_t iteration = 0;     ///< makes random numbers differ from those of other rounds
};

struct PatchMatchContext {
  const MatchScale& scale;
  const BlockViews& views;
  const DenseOptions& options;
  MatchFunction match;
  NoiseByLevel noise{};  ///< of this scale
  RangeLimits limits{};
  uint64_t seed = 0;
};

}  // namespace orbweave
