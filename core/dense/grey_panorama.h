// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/dense/panorama_raster.h"

namespace orbweave {

/// Grey levels of a panorama, with two pixels of what lies beyond every edge: the other side of the
/// seam, and across the poles. Width a multiple of four, height half of it.
struct GreyPanorama {
  static constexpr int kMargin = 2;

  int width_px = 0;
  int height_px = 0;
  std::vector<uint8_t> levels{};   ///< (height_px + 4) x (width_px + 4)
  std::vector<uint8_t> ignored{};  ///< height_px x width_px, or empty

  [[nodiscard]] int Stride() const { return width_px + 2 * kMargin; }
  /// The pixel in `row` and `column`, each from -2 to two beyond the last.
  [[nodiscard]] const uint8_t* At(int row, int column) const {
    return levels.data() + static_cast<ptrdiff_t>(row + kMargin) * Stride() + column + kMargin;
  }
};

/// Whether sizes and buffers fit together: W a multiple of 16 and at least 64, H = W / 2.
[[nodiscard]] bool IsUsable(const PanoramaRaster& raster);

/// Grey levels of a usable raster, row by row: a third of what its colours take.
[[nodiscard]] std::vector<uint8_t> GreyLevelsOf(const PanoramaRaster& raster);

/// `raster` is usable. The same of colours and of their grey levels.
[[nodiscard]] GreyPanorama MakeGreyPanorama(const PanoramaRaster& raster);

/// Half as wide and high, each pixel the mean of four; ignored where one of the four is.
[[nodiscard]] GreyPanorama HalfPanorama(const GreyPanorama& panorama);

}  // namespace orbweave
