// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/panorama_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/geometry/equirectangular_camera.h"

namespace orbweave {
namespace {

double Value(const PanoramaRaster& image, int row, int column, int channel) {
  const int wrapped = (column % image.width_px + image.width_px) % image.width_px;
  const auto width = static_cast<size_t>(image.width_px);
  const auto at = static_cast<size_t>(std::clamp(row, 0, image.height_px - 1)) * width +
                  static_cast<size_t>(wrapped);
  const auto channels = static_cast<size_t>(image.channels);
  return image.pixels[at * channels + static_cast<size_t>(channel)];
}

}  // namespace

Rgb ColorAlong(const PanoramaRaster& image, const Eigen::Vector3d& bearing) {
  if (image.pixels.empty() || image.width_px <= 0 || image.height_px <= 0) return {};
  const EquirectangularCamera camera = {image.width_px, image.height_px};
  const Eigen::Vector2d place = camera.PixelFromBearing(bearing).array() - 0.5;
  const auto column = static_cast<int>(std::floor(place.x()));
  const auto row = static_cast<int>(std::floor(place.y()));
  const double right = place.x() - column;
  const double down = place.y() - row;
  std::array<uint8_t, 3> color{};
  for (int channel = 0; channel < 3; ++channel) {
    const int source = std::min(channel, image.channels - 1);
    const double upper = (1.0 - right) * Value(image, row, column, source) +
                         right * Value(image, row, column + 1, source);
    const double lower = (1.0 - right) * Value(image, row + 1, column, source) +
                         right * Value(image, row + 1, column + 1, source);
    color[static_cast<size_t>(channel)] =
        static_cast<uint8_t>(std::lround((1.0 - down) * upper + down * lower));
  }
  return {color[0], color[1], color[2]};
}

}  // namespace orbweave
