// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/room_texture.h"

#include <cmath>

#include "core/synthetic/shop_front.h"

namespace orbweave {
namespace {

Colour Plaster(const TexturePoint& p, uint32_t seed) {
  const double grain = FractalNoise(p.u_m, p.v_m, {2.0, 0.02}, p.Footprint(), seed);
  return Tinted({0.84, 0.82, 0.77}, 0.05, seed) * (1.0 + 0.05 * grain);
}

/// Boards of 14 cm by 1.2 m, each of its own tone, with grain along them.
Colour Boards(const TexturePoint& p, uint32_t seed) {
  constexpr double kWidth_m = 0.14;
  constexpr double kLength_m = 1.2;
  const double row = std::floor(p.v_m / kWidth_m);
  const double shifted_m = p.u_m + kLength_m * UniformOf(static_cast<int32_t>(row), 0, seed);
  const double column = std::floor(shifted_m / kLength_m);
  const double visible = std::clamp(2.0 - p.Footprint() / (0.5 * kWidth_m), 0.0, 1.0);
  const double tone =
      UniformOf(static_cast<int32_t>(column), static_cast<int32_t>(row), seed) - 0.5;
  const double grain = FractalNoise(0.15 * p.u_m, p.v_m, {0.1, 0.005}, p.Footprint(), seed + 1);
  const double joint = std::max(CoverInterval(p.v_m - row * kWidth_m, 0.0, 0.004, p.dv_m),
                                CoverInterval(shifted_m - column * kLength_m, 0.0, 0.004, p.du_m));
  return Colour(0.50, 0.36, 0.24) * (1.0 + visible * (0.35 * tone - 0.6 * joint) + 0.2 * grain);
}

/// Backs of books in rows of 32 cm.
Colour Books(const TexturePoint& p, uint32_t seed) {
  const double row = std::floor(p.v_m / 0.32);
  const auto shelf = static_cast<int32_t>(row);
  const auto book = static_cast<int32_t>(std::floor(p.u_m / 0.035));
  const double top = 0.2 + 0.08 * UniformOf(book, shelf, seed);
  const double visible = std::clamp(2.0 - p.Footprint() / 0.02, 0.0, 1.0);
  const Colour mean(0.40, 0.34, 0.29);
  const Colour back = Mix(mean, Tinted(mean, 0.9, HashOf(book, shelf, seed)), visible);
  return Mix({0.16, 0.11, 0.08}, back, CoverInterval(p.v_m - 0.32 * row, 0.03, top, p.dv_m));
}

/// Wood with doors or drawers, cloth, or a shelf of books.
Colour Furniture(const TexturePoint& p, int face, uint32_t seed) {
  const Colour wood = Tinted({0.44, 0.32, 0.22}, 0.5, seed);
  const double grain = FractalNoise(p.u_m, 0.2 * p.v_m, {0.3, 0.01}, p.Footprint(), seed);
  if (face / 2 == 2) return wood * (1.0 + 0.15 * grain);
  const bool shelf = p.height_m > 1.5 && UniformOf(0, 5, seed) < 0.6;
  const double inside = CoverInterval(p.u_m, 0.05, p.width_m - 0.05, p.du_m) *
                        CoverInterval(p.v_m, 0.05, p.height_m - 0.05, p.dv_m);
  if (shelf) return Mix(wood, Books(p, seed), inside);
  const double leaf_m = 0.3 + 0.3 * UniformOf(1, 5, seed);
  const double gap =
      std::max(CoverInterval(p.u_m - leaf_m * std::floor(p.u_m / leaf_m), 0.0, 0.012, p.du_m),
               CoverInterval(p.v_m - 0.4 * std::floor(p.v_m / 0.4), 0.0, 0.012, p.dv_m));
  return wood * (1.0 + 0.15 * grain) * (1.0 - 0.6 * inside * gap);
}

Colour Picture(const TexturePoint& p, uint32_t seed) {
  const double inside = CoverInterval(p.u_m, 0.05, p.width_m - 0.05, p.du_m) *
                        CoverInterval(p.v_m, 0.05, p.height_m - 0.05, p.dv_m);
  return Mix(Tinted({0.32, 0.25, 0.18}, 0.7, seed), Motley(p, seed), inside);
}

}  // namespace

Colour RoomColour(SolidKind kind, const TexturePoint& p, int face, uint32_t seed) {
  if (kind == SolidKind::kFloor) return Boards(p, seed);
  if (kind == SolidKind::kFurniture) return Furniture(p, face, seed);
  if (kind == SolidKind::kPicture) return Picture(p, seed);
  return Plaster(p, seed);
}

}  // namespace orbweave
