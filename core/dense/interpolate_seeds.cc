// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/interpolate_seeds.h"

#include <array>
#include <cmath>

#include "core/dense/equiangular_raster.h"
#include "core/dense/pixel_random.h"
#include "core/geometry/cube_face.h"

namespace orbweave {
namespace {

constexpr int kCell_px = 4;
constexpr size_t kNearest = 3;

using NearestSeeds = std::array<float, kNearest>;  // their ranges

NearestSeeds FindNearest(std::span<const DepthSeed> seeds, const Eigen::Vector3d& bearing) {
  std::array<double, kNearest> cosines;
  cosines.fill(-2.0);
  NearestSeeds ranges_m{};
  for (const DepthSeed& seed : seeds) {
    double cosine = seed.bearing.dot(bearing);
    auto range_m = static_cast<float>(seed.range_m);
    if (!(cosine > cosines.back()) || !std::isfinite(range_m) || !(range_m > 0.0F)) continue;
    for (size_t k = 0; k < kNearest; ++k) {
      if (cosine <= cosines[k]) continue;
      std::swap(cosine, cosines[k]);
      std::swap(range_m, ranges_m[k]);
    }
  }
  return ranges_m;
}

}  // namespace

std::vector<float> InterpolateSeeds(std::span<const DepthSeed> seeds, int face_px, uint64_t seed) {
  if (seeds.empty()) return {};
  const EquiangularRaster raster{face_px};
  std::vector<float> ranges_m(raster.NumPixels());
  const int cells = (face_px + kCell_px - 1) / kCell_px;
  for (int face = 0; face < kCubeFaces; ++face) {
    std::vector<NearestSeeds> nearest;
    for (int row = 0; row < cells; ++row) {
      for (int column = 0; column < cells; ++column) {
        nearest.push_back(FindNearest(
            seeds,
            raster.BearingFromPixel(face, kCell_px * (row + 0.5), kCell_px * (column + 0.5))));
      }
    }
    for (int row = 0; row < face_px; ++row) {
      for (int column = 0; column < face_px; ++column) {
        const size_t index = raster.Index(face, row, column);
        PixelRandom random(seed, index, 1);
        const auto draw = static_cast<size_t>(random.Uniform() * 8.0F);
        if (draw == 7) continue;
        const auto& ranges =
            nearest[static_cast<size_t>(row / kCell_px * cells + column / kCell_px)];
        ranges_m[index] = ranges[draw % kNearest] * (1.0F + 0.1F * random.Signed());
      }
    }
  }
  return ranges_m;
}

}  // namespace orbweave
