// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/grey_panorama.h"

#include <algorithm>
#include <cstring>

namespace orbweave {
namespace {

constexpr int kMargin = GreyPanorama::kMargin;

GreyPanorama Blank(int width_px, int height_px) {
  GreyPanorama grey{.width_px = width_px, .height_px = height_px};
  grey.levels.resize(static_cast<size_t>(grey.Stride()) *
                     static_cast<size_t>(height_px + 2 * kMargin));
  return grey;
}

uint8_t* RowOf(GreyPanorama& grey, int row) {
  return grey.levels.data() + static_cast<ptrdiff_t>(row + kMargin) * grey.Stride() + kMargin;
}

void WrapColumns(GreyPanorama& grey, int row) {
  uint8_t* const pixels = RowOf(grey, row);
  for (int k = 1; k <= kMargin; ++k) {
    pixels[-k] = pixels[grey.width_px - k];
    pixels[grey.width_px + k - 1] = pixels[k - 1];
  }
}

/// Beyond a pole lies the same row, half a turn on.
void FillMargins(GreyPanorama& grey) {
  const int half = grey.width_px / 2;
  for (int k = 1; k <= kMargin; ++k) {
    const int pairs[2][2] = {{-k, k - 1}, {grey.height_px + k - 1, grey.height_px - k}};
    for (const auto& [beyond, inside] : pairs) {
      const uint8_t* const from = RowOf(grey, inside);
      std::copy(from + half, from + grey.width_px, RowOf(grey, beyond));
      std::copy(from, from + half, RowOf(grey, beyond) + half);
    }
  }
  for (int row = -kMargin; row < grey.height_px + kMargin; ++row) WrapColumns(grey, row);
}

void CopyGrey(const PanoramaRaster& raster, int row, uint8_t* to) {
  const auto width = static_cast<size_t>(raster.width_px);
  const auto channels = static_cast<size_t>(raster.channels);
  const uint8_t* from = raster.pixels.data() + static_cast<size_t>(row) * width * channels;
  if (raster.channels == 1) {
    std::memcpy(to, from, width);
    return;
  }
  for (size_t k = 0; k < width; ++k, from += 3) {
    to[k] = static_cast<uint8_t>((77 * from[0] + 150 * from[1] + 29 * from[2] + 128) >> 8);
  }
}

}  // namespace

bool IsUsable(const PanoramaRaster& raster) {
  if (raster.width_px < 64 || raster.width_px % 16 != 0) return false;
  if (raster.height_px * 2 != raster.width_px) return false;
  if (raster.channels != 1 && raster.channels != 3) return false;
  const size_t count = static_cast<size_t>(raster.width_px) * static_cast<size_t>(raster.height_px);
  return raster.pixels.size() == count * static_cast<size_t>(raster.channels) &&
         (raster.ignored.empty() || raster.ignored.size() == count);
}

std::vector<uint8_t> GreyLevelsOf(const PanoramaRaster& raster) {
  const auto width = static_cast<size_t>(raster.width_px);
  std::vector<uint8_t> levels(width * static_cast<size_t>(raster.height_px));
  for (int row = 0; row < raster.height_px; ++row)
    CopyGrey(raster, row, levels.data() + static_cast<size_t>(row) * width);
  return levels;
}

GreyPanorama MakeGreyPanorama(const PanoramaRaster& raster) {
  GreyPanorama grey = Blank(raster.width_px, raster.height_px);
  for (int row = 0; row < grey.height_px; ++row) CopyGrey(raster, row, RowOf(grey, row));
  FillMargins(grey);
  grey.ignored.assign(raster.ignored.begin(), raster.ignored.end());
  return grey;
}

GreyPanorama HalfPanorama(const GreyPanorama& panorama) {
  GreyPanorama half = Blank(panorama.width_px / 2, panorama.height_px / 2);
  for (int row = 0; row < half.height_px; ++row) {
    const uint8_t* const a = panorama.At(2 * row, 0);
    const uint8_t* const b = panorama.At(2 * row + 1, 0);
    uint8_t* const to = RowOf(half, row);
    for (int k = 0; k < half.width_px; ++k) {
      to[k] = static_cast<uint8_t>((a[2 * k] + a[2 * k + 1] + b[2 * k] + b[2 * k + 1] + 2) >> 2);
    }
  }
  FillMargins(half);
  if (panorama.ignored.empty()) return half;
  const auto width = static_cast<size_t>(half.width_px);
  half.ignored.resize(width * static_cast<size_t>(half.height_px));
  for (size_t row = 0; row < static_cast<size_t>(half.height_px); ++row) {
    const uint8_t* const a = panorama.ignored.data() + 4 * row * width;
    for (size_t k = 0; k < width; ++k) {
      half.ignored[row * width + k] =
          a[2 * k] | a[2 * k + 1] | a[2 * width + 2 * k] | a[2 * width + 2 * k + 1];
    }
  }
  return half;
}

}  // namespace orbweave
