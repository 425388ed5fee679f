// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace orbweave {

/// A view of somebody's equirectangular pixels: row-major, 8 bits, `channels` 1 (grey) or 3 (red,
/// green, blue). `ignored`: width_px x height_px or empty; what is not 0 takes part in nothing.
struct PanoramaRaster {
  int width_px = 0;
  int height_px = 0;
  int channels = 1;
  std::span<const uint8_t> pixels{};
  std::span<const uint8_t> ignored{};
};

}  // namespace orbweave
