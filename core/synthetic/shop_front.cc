// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/shop_front.h"

#include <algorithm>
#include <cmath>

namespace orbweave {

Colour ShopSign(
    const Colour& wall, double x, const TexturePoint& p, double half_width_m, uint32_t id) {
  constexpr double kLow_m = 2.75;
  constexpr double kHigh_m = 3.4;
  const double y = p.v_m;
  const double on_board = CoverInterval(x, -half_width_m, half_width_m, p.du_m) *
                          CoverInterval(y, kLow_m, kHigh_m, p.dv_m);
  if (on_board == 0.0) return wall;
  constexpr double kDot_m = 0.06;
  const auto column = static_cast<int32_t>(std::floor((x + half_width_m) / kDot_m));
  const auto row = static_cast<int32_t>(std::floor((y - kLow_m - 0.1) / kDot_m));
  const bool in_letter = row >= 0 && row < 7 && column >= 1 && column % 6 != 0;
  const bool ink = in_letter && UniformOf(column, row, id) < 0.5;
  const double visible = std::clamp(2.0 - p.Footprint() / (0.5 * kDot_m), 0.0, 1.0);
  const Colour board = Tinted({0.50, 0.45, 0.42}, 0.9, id);
  const Colour letters = board.sum() > 1.4 ? Colour(0.08, 0.08, 0.1) : Colour(0.9, 0.9, 0.85);
  const double share = in_letter ? std::lerp(0.5, ink ? 1.0 : 0.0, visible) : 0.0;
  return Mix(wall, Mix(board, letters, share), on_board);
}

Colour Motley(const TexturePoint& p, uint32_t id) {
  const double light = FractalNoise(p.u_m, p.v_m, {0.5, 0.03}, p.Footprint(), id);
  const double warm = FractalNoise(p.u_m, p.v_m, {0.6, 0.05}, p.Footprint(), id + 31);
  const Colour colour = Tinted({0.48, 0.45, 0.42}, 0.3, id) * (1.0 + 1.3 * light) +
                        0.35 * warm * Colour(1.0, 0.1, -0.8);
  return colour.cwiseMax(0.03).cwiseMin(0.97);
}

}  // namespace orbweave
