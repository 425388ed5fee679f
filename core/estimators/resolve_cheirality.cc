// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/resolve_cheirality.h"

#include <cmath>
#include <utility>

#include "core/geometry/epipolar.h"
#include "core/geometry/essential.h"

namespace orbweave {

std::vector<uint32_t> InFrontOfBoth(const BearingPairs& pairs,
                                    std::span<const uint32_t> candidates,
                                    const Rigid3& b_from_a,
                                    double max_error_rad) {
  const double min_cos = std::cos(2.0 * max_error_rad);
  const PoseOfRays rays_of(b_from_a);
  std::vector<uint32_t> in_front;
  in_front.reserve(candidates.size());
  for (const uint32_t i : candidates) {
    const RayPair rays = rays_of(pairs.A(i), pairs.B(i));
    if (rays.cosine > min_cos || rays.IsInFrontOfBoth()) in_front.push_back(i);
  }
  return in_front;
}

ResolvedPose ResolveCheirality(const BearingPairs& pairs,
                               const Rigid3& any_of_four,
                               double max_error_rad) {
  const std::vector<uint32_t> inliers = EpipolarInliers(pairs, any_of_four, max_error_rad);
  ResolvedPose best{.b_from_a = any_of_four};
  for (const Rigid3& pose : PosesFromEssential(EssentialFromPose(any_of_four))) {
    std::vector<uint32_t> in_front = InFrontOfBoth(pairs, inliers, pose, max_error_rad);
    if (in_front.size() > best.inliers.size()) best = {pose, std::move(in_front)};
  }
  return best;
}

}  // namespace orbweave
