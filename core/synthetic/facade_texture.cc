// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/facade_texture.h"

#include <array>
#include <cmath>

#include "core/synthetic/plain_facade.h"
#include "core/synthetic/shop_front.h"

namespace orbweave {
namespace {

constexpr double kGroundFloor_m = 3.7;

/// What one house's seed decides.
struct FacadeStyle {
  explicit FacadeStyle(uint32_t house) : seed(house) {
    static const std::array<Colour, 7> kPlasters = {Colour{0.78, 0.70, 0.55},
                                                    Colour{0.74, 0.72, 0.68},
                                                    Colour{0.66, 0.45, 0.36},
                                                    Colour{0.60, 0.64, 0.66},
                                                    Colour{0.80, 0.76, 0.66},
                                                    Colour{0.62, 0.56, 0.44},
                                                    Colour{0.70, 0.58, 0.50}};
    wall = Tinted(kPlasters[HashOf(0, 0, seed) % kPlasters.size()], 0.08, seed);
    brick = UniformOf(1, 0, seed) < 0.35;
    bay_m = 1.9 + 1.3 * UniformOf(2, 0, seed);
    floor_m = 2.9 + 0.6 * UniformOf(3, 0, seed);
    window_half_m = 0.42 + 0.2 * UniformOf(4, 0, seed);
    window_height_m = 1.3 + 0.4 * UniformOf(5, 0, seed);
    frame = UniformOf(6, 0, seed) < 0.7 ? Colour(0.88, 0.88, 0.85) : Colour(0.30, 0.22, 0.16);
  }

  uint32_t seed;
  Colour wall;
  Colour frame;
  bool brick;
  double bay_m;
  double floor_m;
  double window_half_m;
  double window_height_m;
};

/// Bricks of 25 x 8 cm in running bond, each of its own tone, between lighter joints.
Colour Bricks(const Colour& wall, const TexturePoint& p, uint32_t seed) {
  constexpr double kLength_m = 0.25;
  constexpr double kHeight_m = 0.08;
  const double course = std::floor(p.v_m / kHeight_m);
  const double shifted_m = p.u_m + (static_cast<int>(course) % 2 == 0 ? 0.0 : kLength_m / 2.0);
  const double column = std::floor(shifted_m / kLength_m);
  const double visible = std::clamp(2.0 - p.Footprint() / (0.5 * kHeight_m), 0.0, 1.0);
  const double tone =
      UniformOf(static_cast<int32_t>(column), static_cast<int32_t>(course), seed) - 0.5;
  const double joint = std::max(CoverInterval(p.v_m - course * kHeight_m, 0.0, 0.012, p.dv_m),
                                CoverInterval(shifted_m - column * kLength_m, 0.0, 0.012, p.du_m));
  const Colour brick = Colour(0.56, 0.33, 0.26) * (1.0 + 0.45 * visible * tone);
  return Mix(Mix(brick, wall, 0.25), Colour(0.70, 0.67, 0.62), visible * joint);
}

/// Noise of the material and streaks of dirt that run down.
Colour Weathered(const Colour& colour, const TexturePoint& p, uint32_t seed) {
  const double grain = FractalNoise(p.u_m, p.v_m, {1.5, 0.02}, p.Footprint(), seed + 100);
  const double streaks = FractalNoise(p.u_m, 0.15 * p.v_m, {1.2, 0.1}, p.Footprint(), seed + 200);
  const double dirt = std::clamp(streaks - 0.2, 0.0, 0.5);
  return colour * ((1.0 + 0.36 * grain) * (1.0 - 0.7 * dirt));
}

/// Glass with mullions, frame and sill about (0, 0) .. (.., height); x from the window's axis.
SurfaceColour Window(const Colour& wall,
                     double x,
                     double y,
                     const TexturePoint& p,
                     const FacadeStyle& style,
                     uint32_t id) {
  const double w = style.window_half_m;
  const double h = style.window_height_m;
  const auto cover = [&](double left, double right, double low, double high) {
    return CoverInterval(x, left, right, p.du_m) * CoverInterval(y, low, high, p.dv_m);
  };
  Colour colour = Mix(wall, 0.8 * style.frame, cover(-w - 0.18, w + 0.18, -0.2, -0.09));  // sill
  colour = Mix(colour, style.frame, cover(-w - 0.09, w + 0.09, -0.09, h + 0.09));
  Colour glass = Colour(0.13, 0.16, 0.19) + Colour(0.10, 0.11, 0.12) * (y / h);
  const double blind = UniformOf(1, 1, id) < 0.4 ? h * (1.0 - 0.8 * UniformOf(2, 1, id)) : h;
  const double pane = cover(-w, -0.03, 0.0, h) + cover(0.03, w, 0.0, h);
  glass = Mix(glass, Tinted({0.66, 0.62, 0.55}, 0.2, id), CoverInterval(y, blind, h, p.dv_m));
  colour = Mix(colour, glass, pane);
  const double bar = cover(-w, w, 0.62 * h, 0.62 * h + 0.06);
  return {Mix(colour, style.frame, bar), pane * (1.0 - bar), id};
}

/// Door, shop window, poster or bare wall between the axes x = +-bay / 2 of a bay at street level.
SurfaceColour GroundFloor(const Colour& wall,
                          double x,
                          const TexturePoint& p,
                          const FacadeStyle& style,
                          uint32_t id,
                          uint32_t wares) {
  const auto cover = [&](double half, double low, double high, double inset) {
    return CoverInterval(x, -half + inset, half - inset, p.du_m) *
           CoverInterval(p.v_m, low + inset, high - inset, p.dv_m);
  };
  const double kind = UniformOf(0, 0, id);
  const double half = 0.42 * style.bay_m;
  Colour colour = wall;
  double glass = 0.0;
  if (kind < 0.25) {
    const Colour door = Tinted({0.35, 0.27, 0.2}, 0.6, id);
    colour = Mix(colour, style.frame, cover(0.62, 0.0, 2.35, 0.0));
    colour = Mix(colour, door, cover(0.62, 0.0, 2.35, 0.09));
    colour = Mix(colour, 0.6 * door, cover(0.35, 0.3, 1.0, 0.0) + cover(0.35, 1.2, 2.0, 0.0));
  } else if (kind < 0.6) {
    colour = Mix(colour, 0.7 * style.frame, cover(half, 0.5, 2.6, 0.0));
    glass = cover(half, 0.5, 2.6, 0.08);
    colour = Mix(colour, 0.65 * Motley(p, id + wares), glass);
  } else if (kind < 0.8) {
    colour = Mix(colour, Motley(p, id + wares + 7), cover(0.45, 0.8, 2.0, 0.0));
  }
  if (kind < 0.7) colour = ShopSign(colour, x, p, 0.45 * style.bay_m, id + wares);
  return {colour, glass, id};
}

}  // namespace

SurfaceColour FacadeSurface(const TexturePoint& p, uint32_t seed, const FacadeLook& look) {
  if (look.plain) return PlainFacade(p, seed, look);
  const FacadeStyle style(seed);
  Colour colour = style.brick ? Bricks(style.wall, p, seed) : style.wall;
  const double above_m = p.v_m - kGroundFloor_m;
  const double storey = std::floor(above_m / style.floor_m);
  const double in_storey_m = above_m - storey * style.floor_m;
  if (above_m > -0.3) {  // a ledge under every storey
    const double ledge = CoverInterval(in_storey_m, 0.0, 0.16, p.dv_m);
    colour = Mix(colour, 1.12 * style.wall, ledge);
  } else {
    colour = Mix(colour, Tinted(0.75 * style.wall, 0.15, seed + 5), 0.7);
  }
  colour = Weathered(colour, p, seed);

  const double bays = std::max(1.0, std::floor((p.width_m - 0.4) / style.bay_m));
  const double from_first_m = p.u_m - (p.width_m - bays * style.bay_m) / 2.0;
  const double bay = std::floor(from_first_m / style.bay_m);
  if (bay < 0.0 || bay >= bays) return {colour};
  const double x = from_first_m - (bay + 0.5) * style.bay_m;
  const auto column = static_cast<int32_t>(bay);
  if (above_m < 0.0) return GroundFloor(colour, x, p, style, HashOf(column, -1, seed), look.wares);
  if ((storey + 1.0) * style.floor_m + kGroundFloor_m > p.height_m) return {colour};
  const uint32_t id =
      look.equal_windows ? seed : HashOf(column, static_cast<int32_t>(storey), seed);
  return Window(colour, x, in_storey_m - 0.85, p, style, id);
}

}  // namespace orbweave
