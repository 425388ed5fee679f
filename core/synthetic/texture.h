// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "core/synthetic/noise.h"

namespace orbweave {

/// Red, green, blue in [0, 1] as displayed (no gamma is applied anywhere).
using Colour = Eigen::Vector3d;

/// What a surface shows by itself, and the share of it that is glass before which the street
/// mirrors.
struct SurfaceColour {
  Colour colour = Colour::Zero();
  double glass = 0.0;
  uint32_t pane = 0;  ///< panes of different numbers hang a little askew to each other
};

/// A place on a flat surface and how much of it one pixel covers: textures filter themselves.
struct TexturePoint {
  double u_m = 0.0;  ///< from the left edge
  double v_m = 0.0;  ///< from the lower edge
  double width_m = 0.0;
  double height_m = 0.0;
  double du_m = 0.01;  ///< extent of the pixel along u
  double dv_m = 0.01;

  /// The pixel's size for isotropic noise.
  [[nodiscard]] double Footprint() const { return std::max(du_m, dv_m); }
};

/// Share of a pixel of size `extent` about x that lies in [low, high]: a box filter.
inline double CoverInterval(double x, double low, double high, double extent) {
  const double above_low = std::clamp((x - low) / extent + 0.5, 0.0, 1.0);
  const double above_high = std::clamp((x - high) / extent + 0.5, 0.0, 1.0);
  return above_low - above_high;
}

inline Colour Mix(const Colour& below, const Colour& above, double share) {
  return below + share * (above - below);
}

/// A colour near `base` drawn from `seed`: brighter or darker by up to `amount`, and tinted by a
/// third of that.
inline Colour Tinted(const Colour& base, double amount, uint32_t seed) {
  Colour colour = base * (1.0 + amount * (2.0 * UniformOf(3, 17, seed) - 1.0));
  for (int c = 0; c < 3; ++c)
    colour[c] *= 1.0 + amount / 3.0 * (2.0 * UniformOf(c, 17, seed) - 1.0);
  return colour.cwiseMin(1.0);
}

}  // namespace orbweave
