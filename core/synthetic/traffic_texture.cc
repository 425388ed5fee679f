// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/traffic_texture.h"

#include <array>
#include <cmath>

#include "core/synthetic/shop_front.h"

namespace orbweave {
namespace {

constexpr double kTallestHead_m = 0.3;
constexpr double kClearCoat = 0.5;  // a car's paint mirrors half as much as a pane

Colour Paint(uint32_t seed) {
  static const std::array<Colour, 6> kPaints = {Colour{0.70, 0.71, 0.72},
                                                Colour{0.13, 0.14, 0.16},
                                                Colour{0.55, 0.10, 0.10},
                                                Colour{0.14, 0.22, 0.42},
                                                Colour{0.84, 0.84, 0.82},
                                                Colour{0.36, 0.38, 0.36}};
  return Tinted(kPaints[HashOf(0, 9, seed) % kPaints.size()], 0.1, seed);
}

double DiscCover(const TexturePoint& p, double u_m, double v_m, double radius_m) {
  return CoverInterval(std::hypot(p.u_m - u_m, p.v_m - v_m), -1.0, radius_m, p.Footprint());
}

double RectangleCover(const TexturePoint& p, double left, double right, double low, double high) {
  return CoverInterval(p.u_m, left, right, p.du_m) * CoverInterval(p.v_m, low, high, p.dv_m);
}

}  // namespace

SurfaceColour CarBody(const TexturePoint& p, int face, uint32_t seed) {
  const double dust = FractalNoise(p.u_m, p.v_m, {1.0, 0.03}, p.Footprint(), HashOf(face, 1, seed));
  const Colour paint = Paint(seed) * (1.0 + 0.25 * dust);
  const Colour dark(0.05, 0.05, 0.06);
  const Colour bright(0.75, 0.74, 0.68);
  if (face / 2 == 1) {
    Colour colour = paint;
    for (const double u : {0.19 * p.width_m, 0.81 * p.width_m}) {
      colour = Mix(colour, dark, DiscCover(p, u, 0.1, 0.36));
      colour = Mix(colour, 0.6 * bright, DiscCover(p, u, 0.1, 0.19));
    }
    for (const double u : {0.33, 0.52, 0.68}) {
      colour = Mix(
          colour, 0.4 * paint, CoverInterval(p.u_m, u * p.width_m, u * p.width_m + 0.015, p.du_m));
    }
    return {colour, kClearCoat, seed};
  }
  if (face / 2 == 0) {
    const double plate =
        CoverInterval(p.u_m, 0.63, 1.15, p.du_m) * CoverInterval(p.v_m, 0.2, 0.32, p.dv_m);
    const Colour lamp = face % 2 == 1 ? bright : Colour(0.6, 0.08, 0.06);
    const double lamps =
        DiscCover(p, 0.25, 0.45, 0.13) + DiscCover(p, p.width_m - 0.25, 0.45, 0.13);
    return {Mix(Mix(paint, bright, plate), lamp, lamps), kClearCoat, seed};
  }
  return {paint, kClearCoat, seed};
}

SurfaceColour CarCabin(const TexturePoint& p, int face, uint32_t seed) {
  const Colour paint = Paint(seed);
  if (face / 2 == 2) return {paint, kClearCoat, seed};
  const double columns = CoverInterval(p.u_m, 0.1, 0.5 * p.width_m - 0.04, p.du_m) +
                         CoverInterval(p.u_m, 0.5 * p.width_m + 0.04, p.width_m - 0.1, p.du_m);
  const double pane = columns * CoverInterval(p.v_m, 0.05, p.height_m - 0.08, p.dv_m);
  return {Mix(paint, {0.10, 0.12, 0.14}, pane), std::lerp(kClearCoat, 1.0, pane), seed};
}

SurfaceColour Bus(const TexturePoint& p, int face, uint32_t seed) {
  const Colour paint = Tinted({0.62, 0.55, 0.40}, 0.5, seed);
  const Colour glass(0.07, 0.08, 0.10);
  const double w = p.width_m;
  const double h = p.height_m;
  if (face / 2 == 2) return {Colour(0.75, 0.75, 0.74), 0.0, seed};
  Colour colour = Mix(paint, 0.45 * paint, RectangleCover(p, 0.0, w, 0.0, 0.18 * h));
  const double band = RectangleCover(p, 0.12, w - 0.12, 0.5 * h, 0.86 * h);
  colour = Mix(colour, glass, band);
  double pillars = 0.0;
  if (face / 2 == 1) {
    for (double u = 1.4; u < w - 0.4; u += 1.4) {
      pillars += CoverInterval(p.u_m, u - 0.05, u + 0.05, p.du_m);
    }
    for (const double u : {0.2 * w, 0.78 * w}) {
      colour = Mix(colour, {0.05, 0.05, 0.05}, DiscCover(p, u, 0.02, 0.48));
      colour = Mix(colour, {0.45, 0.45, 0.44}, DiscCover(p, u, 0.02, 0.22));
    }
  } else {
    const Colour lamp = face % 2 == 1 ? Colour(0.85, 0.83, 0.75) : Colour(0.62, 0.07, 0.05);
    colour = Mix(colour, Motley(p, seed), RectangleCover(p, 0.45, w - 0.45, 0.26 * h, 0.46 * h));
    colour = Mix(colour, {0.80, 0.79, 0.72}, RectangleCover(p, 0.38 * w, 0.62 * w, 0.1, 0.24));
    const double lamps =
        RectangleCover(p, 0.1, 0.3, 0.2, 0.7) + RectangleCover(p, w - 0.3, w - 0.1, 0.2, 0.7);
    colour = Mix(colour, lamp, lamps);
  }
  colour = Mix(colour, paint, pillars * band);
  return {colour, std::max(kClearCoat, band * (1.0 - pillars)), seed};
}

Colour Clothes(const Eigen::Vector3d& local, double height_m, double pixel_m, uint32_t seed) {
  if (height_m < kTallestHead_m) {
    const bool hair = local.z() > 0.02 || local.x() < -0.03;
    return hair ? Tinted({0.20, 0.15, 0.11}, 0.8, seed) : Tinted({0.58, 0.43, 0.35}, 0.4, seed);
  }
  const double folds =
      FractalNoise(local.x() + local.y(), 0.5 * local.z(), {0.3, 0.03}, pixel_m, seed);
  const Colour cloth = Tinted({0.26, 0.26, 0.29}, 0.8, seed);
  return (cloth * (1.0 + 0.3 * folds)).cwiseMax(0.02);
}

}  // namespace orbweave
