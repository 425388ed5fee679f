// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/dense/grey_panorama.h"
#include "core/geometry/cube_face.h"

namespace orbweave {

/// The reference panorama on the equiangular raster of face_px = W / 4, each face continued by
/// kApron_px pixels over its edges by the raster's own formula.
struct ReferenceRaster {
  static constexpr int kApron_px = 10;

  int face_px = 0;
  std::array<std::vector<uint8_t>, kCubeFaces> levels{};   ///< Stride() x Stride(), and some more
  std::array<std::vector<uint8_t>, kCubeFaces> ignored{};  ///< the same, or empty
  std::vector<float> tangents{};                           ///< x / z of columns, y / z of rows
  std::vector<float> tangent_steps{};                      ///< their derivatives by a pixel

  [[nodiscard]] int Stride() const { return face_px + 2 * kApron_px; }
};

[[nodiscard]] ReferenceRaster MakeReferenceRaster(const GreyPanorama& panorama);

}  // namespace orbweave
