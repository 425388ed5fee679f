// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

#include "core/graph/pair_options.h"
#include "core/scene/image_manifest.h"
#include "core/scene/usual_step.h"

namespace orbweave {

/// False where both positions are known and say that two panoramas are too far apart to see the
/// same: further by their horizontal distance than max(similar_gate_m, similar_gate_sigmas (sigma_a
/// + sigma_b)).
[[nodiscard]] inline bool MayBeNear(const PosePrior& a,
                                    const PosePrior& b,
                                    const PairOptions& options) {
  if (!a.position_in_enu || !b.position_in_enu) return true;
  const double sigma_m = a.horizontal_sigma_m + b.horizontal_sigma_m;
  return DistanceBetween(a, b) <=
         std::max(options.similar_gate_m, options.similar_gate_sigmas * sigma_m);
}

}  // namespace orbweave
