// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/sky_texture.h"

#include <cmath>

namespace orbweave {
namespace {

/// Height of the hills' crest above the horizon, radians; periodic without a seam.
double CrestOf(const Eigen::Vector3d& direction, double pixel_rad, uint32_t seed) {
  const Eigen::Vector2d d = direction.head<2>().normalized();
  return 0.06 + 0.05 * FractalNoise(d.x(), d.y(), {1.0, 0.02}, pixel_rad, seed);
}

}  // namespace

Colour SkyColour(const Eigen::Vector3d& direction,
                 double pixel_rad,
                 uint32_t seed,
                 uint32_t clouds,
                 const Eigen::Vector2d& drift) {
  const double up = std::max(0.0, direction.z());
  Colour colour = Mix({0.78, 0.84, 0.90}, {0.34, 0.52, 0.80}, std::sqrt(up));
  // A layer of clouds on a shell: the plane coordinate stays finite at the horizon.
  const double scale = 1.0 / (up + 0.25);
  const double cloud = FractalNoise(scale * direction.x() + drift.x(),
                                    scale * direction.y() + drift.y(),
                                    {1.2, 0.02},
                                    1.5 * scale * pixel_rad,
                                    seed + 1000 * clouds);
  colour = Mix(colour, {0.95, 0.95, 0.96}, std::clamp(1.6 * cloud + 0.35, 0.0, 0.95));
  if (up > 0.3) return colour;
  const double elevation = std::asin(direction.z());
  const double hill =
      CoverInterval(elevation, -2.0, CrestOf(direction, pixel_rad, seed + 99), pixel_rad);
  return Mix(colour, {0.42, 0.50, 0.50}, hill);
}

}  // namespace orbweave
