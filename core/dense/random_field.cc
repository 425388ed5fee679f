// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/random_field.h"

#include <cmath>

#include "core/dense/random_plane.h"

namespace orbweave {
namespace {

constexpr int kApron = PlaneField::kApron_px;

}  // namespace

PlaneField RandomField(const ReferenceRaster& raster,
                       const RangeLimits& limits,
                       const std::vector<float>& ranges_m,
                       uint64_t seed) {
  PlaneField field(raster.face_px);
  size_t pixel = 0;
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = kApron; row < kApron + raster.face_px; ++row) {
      for (int column = kApron; column < kApron + raster.face_px; ++column, ++pixel) {
        const float x = raster.tangents[static_cast<size_t>(column)];
        const float y = raster.tangents[static_cast<size_t>(row)];
        const float ray = std::sqrt(x * x + y * y + 1.0F);
        PixelRandom random(seed, pixel, 0);
        const bool known = !ranges_m.empty() && ranges_m[pixel] > 0.0F;
        const RayPlane q = known ? FacingPlane(x, y, ray / ranges_m[pixel], random)
                                 : RandomPlane(x, y, limits, random);
        const size_t at = field.AtPixel(face, row, column);
        field.x[at] = q.x;
        field.y[at] = q.y;
        field.z[at] = q.z;
      }
    }
  }
  return field;
}

PlaneField DoubleField(const PlaneField& half) {
  PlaneField field(2 * half.FacePx());
  for (int face = 0; face < kCubeFaces; ++face) {
    for (int row = 0; row < field.FacePx(); ++row) {
      for (int column = 0; column < field.FacePx(); ++column) {
        const size_t from = half.AtPixel(face, kApron + row / 2, kApron + column / 2);
        const size_t to = field.AtPixel(face, kApron + row, kApron + column);
        field.x[to] = half.x[from];
        field.y[to] = half.y[from];
        field.z[to] = half.z[from];
        field.cost[to] = half.cost[from];
      }
    }
  }
  return field;
}

}  // namespace orbweave
