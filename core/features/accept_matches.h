// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/nearest_two.h"
#include "core/scene/ids.h"

namespace orbweave {

struct AcceptanceLimits {
  double max_ratio = 0.8;     ///< best over second-best distance, below
  double max_distance = 0.7;  ///< of unit descriptors, at most
  bool cross_check = true;    ///< each must pass as the other's best; one-to-one, symmetric
};

/// The nearest neighbours that are good enough, sorted by (a, b). With cross check the result for
/// (b, a) is the same with both sides exchanged; without, only the limits of a's side count.
/// A neighbour without a second best passes the ratio test.
[[nodiscard]] std::vector<FeatureMatch> AcceptMatches(const NearestTwoBothWays& nearest,
                                                      const AcceptanceLimits& limits);

}  // namespace orbweave
