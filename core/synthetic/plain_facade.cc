// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/plain_facade.h"

#include <array>
#include <cmath>

#include "core/synthetic/shop_front.h"

namespace orbweave {
namespace {

const Colour kGlass(0.09, 0.11, 0.13);

/// What one house's seed decides.
struct PlainStyle {
  explicit PlainStyle(uint32_t house) : seed(house) {
    static const std::array<Colour, 8> kPlasters = {Colour{0.78, 0.74, 0.66},
                                                    Colour{0.74, 0.73, 0.70},
                                                    Colour{0.78, 0.69, 0.56},
                                                    Colour{0.68, 0.62, 0.55},
                                                    Colour{0.66, 0.68, 0.68},
                                                    Colour{0.82, 0.80, 0.75},
                                                    Colour{0.70, 0.58, 0.49},
                                                    Colour{0.60, 0.57, 0.52}};
    wall = Tinted(kPlasters[HashOf(0, 0, seed) % kPlasters.size()], 0.05, seed);
    brick = UniformOf(1, 0, seed) < 0.25;
    if (brick) wall = Tinted({0.50, 0.34, 0.28}, 0.12, seed);
    trim = brick || UniformOf(2, 0, seed) < 0.5 ? Colour(0.78, 0.76, 0.71) : 0.86 * wall;
    frame = UniformOf(3, 0, seed) < 0.75 ? Colour(0.84, 0.84, 0.82) : Colour(0.26, 0.20, 0.16);
    shutter = Tinted({0.30, 0.34, 0.32}, 0.5, seed + 1);
    shutters = UniformOf(4, 0, seed) < 0.3;
    ground_floor_m = 3.5 + 0.6 * UniformOf(5, 0, seed);
    floor_m = 2.9 + 0.5 * UniformOf(6, 0, seed);
    bay_m = 2.1 + 1.2 * UniformOf(7, 0, seed);
    window_half_m = 0.42 + 0.16 * UniformOf(8, 0, seed);
    window_height_m = 1.4 + 0.4 * UniformOf(9, 0, seed);
  }

  uint32_t seed;
  Colour wall;
  Colour trim;
  Colour frame;
  Colour shutter;
  bool brick;
  bool shutters;
  double ground_floor_m;
  double floor_m;
  double bay_m;
  double window_half_m;
  double window_height_m;
};

/// A place relative to the axis and lower edge of a window or door, with a painter of rectangles.
struct Opening {
  double x = 0.0;
  double y = 0.0;
  const TexturePoint& p;

  [[nodiscard]] double Cover(double left, double right, double low, double high) const {
    return CoverInterval(x, left, right, p.du_m) * CoverInterval(y, low, high, p.dv_m);
  }
  void Paint(SurfaceColour& on, double half, double low, double high, const Colour& c) const {
    const double share = Cover(-half, half, low, high);
    on.colour = Mix(on.colour, c, share);
    on.glass *= 1.0 - share;
  }
  void Glaze(SurfaceColour& on, double half, double low, double high, const Colour& c) const {
    const double share = Cover(-half, half, low, high);
    on.colour = Mix(on.colour, c, share);
    on.glass = std::lerp(on.glass, 1.0, share);
  }
};

/// Courses that all look the same.
Colour EvenBricks(const Colour& wall, const TexturePoint& p) {
  constexpr double kLength_m = 0.24;
  constexpr double kHeight_m = 0.075;
  const double visible = std::clamp(2.0 - p.Footprint() / (0.5 * kHeight_m), 0.0, 1.0);
  if (visible == 0.0) return 1.05 * wall;
  const double course = std::floor(p.v_m / kHeight_m);
  const double shifted_m = p.u_m + (std::fmod(course, 2.0) == 0.0 ? 0.0 : kLength_m / 2.0);
  const double column = std::floor(shifted_m / kLength_m);
  const double joint = std::max(CoverInterval(p.v_m - course * kHeight_m, 0.0, 0.01, p.dv_m),
                                CoverInterval(shifted_m - column * kLength_m, 0.0, 0.01, p.du_m));
  return Mix(1.05 * wall, wall, visible) + visible * joint * Colour::Constant(0.12);
}

/// Plaster or bricks with plinth, courses and downpipe; darker towards the ground.
Colour Wall(const TexturePoint& p, const PlainStyle& style) {
  Colour colour = style.brick ? EvenBricks(style.wall, p) : style.wall;
  const double grain = FractalNoise(p.u_m, p.v_m, {2.5, 0.02}, p.Footprint(), style.seed + 100);
  colour *= (1.0 + 0.05 * grain) * (1.0 - 0.12 * std::exp(-p.v_m / 0.8));
  const auto band = [&](double low, double high, const Colour& c) {
    colour = Mix(colour, c, CoverInterval(p.v_m, low, high, p.dv_m));
  };
  band(0.0, 0.55, 0.62 * style.wall);
  band(style.ground_floor_m - 0.22, style.ground_floor_m, style.trim);
  band(style.ground_floor_m - 0.27, style.ground_floor_m - 0.22, 0.55 * style.wall);  // its shadow
  band(p.height_m - 0.4, p.height_m + 1.0, style.trim);
  band(p.height_m - 0.5, p.height_m - 0.4, 0.5 * style.wall);
  const double pipe = CoverInterval(p.u_m, 0.22, 0.32, p.du_m);
  return Mix(colour, {0.42, 0.41, 0.39}, pipe);
}

/// A window in its surround, with sill, bars, and the curtains or blind of `id`.
SurfaceColour PlainWindow(const Colour& wall,
                          const Opening& o,
                          const PlainStyle& style,
                          uint32_t id) {
  const double w = style.window_half_m;
  const double h = style.window_height_m;
  SurfaceColour s{.colour = wall, .pane = id};
  if (style.shutters) {
    const double both = o.Cover(-2.0 * w, -w, 0.0, h) + o.Cover(w, 2.0 * w, 0.0, h);
    const double slat = o.p.dv_m < 0.06 ? 0.12 * std::cos(2.0 * 3.14159265 * o.y / 0.12) : 0.0;
    s.colour = Mix(s.colour, style.shutter * (1.0 + slat), both);
  }
  o.Paint(s, w + 0.12, -0.12, h + 0.14, style.trim);
  o.Paint(s, w + 0.18, -0.14, -0.06, 1.08 * style.trim);
  o.Paint(s, w + 0.14, -0.22, -0.14, 0.78 * wall);  // the sill's shadow
  o.Paint(s, w, 0.0, h, style.frame);
  const Colour room = kGlass * (0.7 + 0.8 * UniformOf(0, 1, id));
  o.Glaze(s, w - 0.06, 0.06, h - 0.06, room);
  const double kind = UniformOf(1, 1, id);
  if (kind < 0.35) {  // curtains at both sides
    const double open = w * (0.2 + 0.6 * UniformOf(2, 1, id));
    const double cloth =
        o.Cover(-w + 0.06, -open, 0.06, h - 0.06) + o.Cover(open, w - 0.06, 0.06, h - 0.06);
    s.colour = Mix(s.colour, Tinted({0.50, 0.49, 0.46}, 0.15, id), cloth);
  } else if (kind < 0.55) {  // a blind
    o.Glaze(s, w - 0.06, h * (0.9 - 0.8 * UniformOf(2, 1, id)), h - 0.06, {0.52, 0.50, 0.45});
  }
  o.Paint(s, 0.035, 0.0, h, style.frame);
  o.Paint(s, w, 0.66 * h, 0.66 * h + 0.05, style.frame);
  o.Paint(s, w, h - 0.02, h + 0.05, 0.5 * wall);  // shadow of the reveal
  return s;
}

SurfaceColour Door(const Colour& wall, const Opening& o, const PlainStyle& style, uint32_t id) {
  const Colour leaf = Tinted({0.28, 0.22, 0.18}, 0.6, id);
  SurfaceColour s{.colour = wall, .pane = id};
  o.Paint(s, 0.68, 0.0, 2.6, style.trim);
  o.Paint(s, 0.55, 0.0, 2.1, leaf);
  o.Paint(s, 0.36, 0.25, 0.9, 0.75 * leaf);
  o.Paint(s, 0.36, 1.05, 1.9, 0.75 * leaf);
  o.Glaze(s, 0.5, 2.16, 2.5, kGlass);
  o.Paint(s, 0.68, 0.0, 0.08, {0.45, 0.44, 0.42});
  return s;
}

/// A gate of equal slats.
SurfaceColour Gateway(const Colour& wall, const Opening& o, double half, uint32_t id) {
  const Colour paint = Tinted({0.42, 0.42, 0.40}, 0.35, id);
  SurfaceColour s{.colour = wall, .pane = id};
  o.Paint(s, half, 0.0, 2.5, 0.55 * wall);
  const double slat = std::clamp(2.0 - o.p.dv_m / 0.1, 0.0, 1.0) *
                      CoverInterval(o.y - 0.25 * std::floor(o.y / 0.25), 0.0, 0.03, o.p.dv_m);
  o.Paint(s, half - 0.12, 0.0, 2.38, paint * (1.0 - 0.4 * slat));
  return s;
}

SurfaceColour Shop(const Colour& wall, const Opening& o, double half, uint32_t id, uint32_t wares) {
  SurfaceColour s{.colour = wall, .pane = id};
  const Colour frame = Tinted({0.30, 0.29, 0.28}, 0.6, id);
  o.Paint(s, half, 0.35, 2.6, frame);
  o.Glaze(s, half - 0.08, 0.6, 2.5, 0.5 * Motley(o.p, id + wares));
  o.Paint(s, 0.03, 0.6, 2.5, frame);
  s.colour = ShopSign(s.colour, o.x, o.p, half, id + wares);
  return s;
}

SurfaceColour StreetLevel(
    const Colour& wall, const Opening& o, const PlainStyle& style, uint32_t id, uint32_t wares) {
  const double kind = UniformOf(0, 0, id);
  const double half = 0.44 * style.bay_m;
  if (kind < 0.22) return Door(wall, o, style, id);
  if (kind < 0.32) return Gateway(wall, o, half, id);
  if (kind < 0.62) return Shop(wall, o, half, id, wares);
  if (kind < 0.85) return PlainWindow(wall, {o.x, o.y - 1.0, o.p}, style, id);
  return {.colour = wall};
}

}  // namespace

SurfaceColour PlainFacade(const TexturePoint& p, uint32_t seed, const FacadeLook& look) {
  const PlainStyle style(seed);
  const Colour wall = Wall(p, style);
  const double bays = std::max(1.0, std::floor((p.width_m - 0.9) / style.bay_m));
  const double from_first_m = p.u_m - (p.width_m - bays * style.bay_m) / 2.0;
  const double bay = std::floor(from_first_m / style.bay_m);
  if (bay < 0.0 || bay >= bays) return {wall};
  const double x = from_first_m - (bay + 0.5) * style.bay_m;
  const auto column = static_cast<int32_t>(bay);
  const double above_m = p.v_m - style.ground_floor_m;
  if (above_m < -0.1) {
    return StreetLevel(wall, {x, p.v_m, p}, style, HashOf(column, -1, seed), look.wares);
  }
  const double storey = std::max(0.0, std::floor(above_m / style.floor_m));
  if ((storey + 1.0) * style.floor_m + style.ground_floor_m > p.height_m) return {wall};
  const uint32_t id =
      look.equal_windows ? seed : HashOf(column, static_cast<int32_t>(storey), seed);
  const double y = above_m - storey * style.floor_m - 0.85;
  return PlainWindow(wall, {x, y, p}, style, id);
}

}  // namespace orbweave
