// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/remove_speckles.h"

#include <algorithm>
#include <cmath>

#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"
#include "core/graph/disjoint_sets.h"

namespace orbweave {
namespace {

constexpr float kJump = 0.05F;

bool AreOneSurface(float a, float b) {
  return a > 0.0F && b > 0.0F && std::abs(a - b) < kJump * std::min(a, b);
}

}  // namespace

void RemoveSpeckles(int min_pixels, DepthMap& map) {
  const auto size = static_cast<uint32_t>(map.face_px);
  const size_t area = static_cast<size_t>(size) * size;
  for (size_t face = 0; face < kCubeFaces; ++face) {
    float* const range_m = map.range_m.data() + face * area;
    DisjointSets sets(size * size);
    for (uint32_t k = 0; k < area; ++k) {
      if (k % size + 1 < size && AreOneSurface(range_m[k], range_m[k + 1])) sets.Unite(k, k + 1);
      if (k + size < area && AreOneSurface(range_m[k], range_m[k + size])) sets.Unite(k, k + size);
    }
    for (uint32_t k = 0; k < area; ++k) {
      if (sets.SizeOf(k) < static_cast<uint32_t>(min_pixels)) range_m[k] = 0.0F;
    }
  }
}

}  // namespace orbweave
