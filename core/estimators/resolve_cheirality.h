// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/estimators/bearing_pairs.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Those of `candidates` (indices of pairs) whose point lies in front of both panoramas,
/// IsInFrontOfBoth. Rays that meet at less than twice the error are far points without a reliable
/// side: they stay.
[[nodiscard]] std::vector<uint32_t> InFrontOfBoth(const BearingPairs& pairs,
                                                  std::span<const uint32_t> candidates,
                                                  const Rigid3& b_from_a,
                                                  double max_error_rad);

struct ResolvedPose {
  Rigid3 b_from_a{};
  std::vector<uint32_t> inliers{};  ///< ascending
};

/// The pose among the four of one essential matrix with most epipolar inliers in front of both
/// panoramas, and these inliers (paper 3.3).
[[nodiscard]] ResolvedPose ResolveCheirality(const BearingPairs& pairs,
                                             const Rigid3& any_of_four,
                                             double max_error_rad);

}  // namespace orbweave
