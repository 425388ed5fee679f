// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "core/dense/patch_match_round.h"
#include "core/dense/pixel_random.h"

namespace orbweave {

/// q.x = 1 in the frame of a face.
struct RayPlane {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;

  /// Along the ray (x, y, 1), in units of its length.
  [[nodiscard]] float InverseDepth(float ray_x, float ray_y) const {
    return x * ray_x + y * ray_y + z;
  }
};

/// Through the point of inverse depth `p0` on the ray (x, y, 1); its normal is up to about 60
/// degrees from the ray.
inline RayPlane FacingPlane(float x, float y, float p0, PixelRandom& random) {
  const float ray = std::sqrt(x * x + y * y + 1.0F);
  const RayPlane n = {
      x / ray + random.Signed(), y / ray + random.Signed(), 1.0F / ray + random.Signed()};
  const float along = n.InverseDepth(x, y);
  if (along < 0.3F * ray) return {x * p0 / (ray * ray), y * p0 / (ray * ray), p0 / (ray * ray)};
  const float factor = p0 / along;
  return {n.x * factor, n.y * factor, n.z * factor};
}

/// At a range drawn uniformly between the inverse limits.
inline RayPlane RandomPlane(float x, float y, const RangeLimits& limits, PixelRandom& random) {
  const float ray = std::sqrt(x * x + y * y + 1.0F);
  const float low = 1.0F / limits.max_m;
  const float inverse_range = low + (1.0F / limits.min_m - low) * random.Uniform();
  return FacingPlane(x, y, ray * inverse_range, random);
}

}  // namespace orbweave
