// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/remove_speckles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/dense/equiangular_raster.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr float kJump = 0.05F;

/// Disjoint sets of the pixels of a face; the root of a set is its smallest pixel.
class PixelSets {
 public:
  explicit PixelSets(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  uint32_t Root(uint32_t k) {
    while (parent_[k] != k) {
      parent_[k] = parent_[parent_[k]];
      k = parent_[k];
    }
    return k;
  }
  void Join(uint32_t a, uint32_t b) {
    a = Root(a);
    b = Root(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<uint32_t> parent_;
};

bool AreOneSurface(float a, float b) {
  return a > 0.0F && b > 0.0F && std::abs(a - b) < kJump * std::min(a, b);
}

}  // namespace

void RemoveSpeckles(int min_pixels, DepthMap& map) {
  const auto size = static_cast<uint32_t>(map.face_px);
  const size_t area = static_cast<size_t>(size) * size;
  for (size_t face = 0; face < kCubeFaces; ++face) {
    float* const range_m = map.range_m.data() + face * area;
    PixelSets sets(area);
    for (uint32_t k = 0; k < area; ++k) {
      if (k % size + 1 < size && AreOneSurface(range_m[k], range_m[k + 1])) sets.Join(k, k + 1);
      if (k + size < area && AreOneSurface(range_m[k], range_m[k + size])) sets.Join(k, k + size);
    }
    std::vector<int> counts(area);
    for (uint32_t k = 0; k < area; ++k) ++counts[sets.Root(k)];
    for (uint32_t k = 0; k < area; ++k) {
      if (counts[sets.Root(k)] < min_pixels) range_m[k] = 0.0F;
    }
  }
}

}  // namespace orbweave
