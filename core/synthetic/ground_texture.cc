// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/ground_texture.h"

#include <cmath>

namespace orbweave {
namespace {

using Profile = StreetProfile;

/// Rectangles of newer, darker asphalt in some cells of a 3 m raster.
double PatchCover(const Eigen::Vector2d& place, double footprint_m, uint32_t seed) {
  constexpr double kCell_m = 3.0;
  const auto i = static_cast<int32_t>(std::floor(place.x() / kCell_m));
  const auto j = static_cast<int32_t>(std::floor(place.y() / kCell_m));
  if (UniformOf(i, j, seed) > 0.3) return 0.0;
  const double half_x = 0.3 + 0.7 * UniformOf(i, j, seed + 1);
  const double half_y = 0.3 + 0.7 * UniformOf(i, j, seed + 2);
  const double x = place.x() - (i + 0.5) * kCell_m;
  const double y = place.y() - (j + 0.5) * kCell_m;
  return CoverInterval(x, -half_x, half_x, footprint_m) *
         CoverInterval(y, -half_y, half_y, footprint_m);
}

/// Iron lids of 60 cm with rings, one in some cells of a 7 m raster.
Colour WithManhole(const Colour& asphalt,
                   const Eigen::Vector2d& place,
                   double footprint_m,
                   uint32_t seed) {
  constexpr double kCell_m = 7.0;
  const auto i = static_cast<int32_t>(std::floor(place.x() / kCell_m));
  const auto j = static_cast<int32_t>(std::floor(place.y() / kCell_m));
  if (UniformOf(i, j, seed) > 0.5) return asphalt;
  const Eigen::Vector2d middle((i + 0.15 + 0.7 * UniformOf(i, j, seed + 1)) * kCell_m,
                               (j + 0.15 + 0.7 * UniformOf(i, j, seed + 2)) * kCell_m);
  const double r = (place - middle).norm();
  const Colour iron = Colour(0.22, 0.21, 0.20) * (UniformOf(i, j, seed + 3) + 0.6);
  Colour lid = Mix(iron, 1.8 * iron, CoverInterval(r, 0.1, 0.15, footprint_m));
  lid = Mix(lid, 1.6 * iron, CoverInterval(r, 0.22, 0.25, footprint_m));
  return Mix(asphalt, lid, CoverInterval(r, -1.0, 0.3, footprint_m));
}

/// Dashes between the lanes; dirt and wear thin them out.
Colour WithLaneMarks(const Colour& asphalt,
                     const StreetLayout& layout,
                     const Eigen::Vector2d& place,
                     double from_axis_m,
                     double wear,
                     double footprint_m) {
  const Eigen::Vector2d beyond = place.cwiseAbs() - layout.half_m;
  const double along_m = beyond.y() > beyond.x() ? place.x() : place.y();
  const double in_dash_m = along_m - 3.0 * std::floor(along_m / 3.0);
  const double mark =
      CoverInterval(
          from_axis_m, Profile::kLaneMark_m - 0.07, Profile::kLaneMark_m + 0.07, footprint_m) *
      CoverInterval(in_dash_m, 0.4, 2.0, footprint_m);
  return Mix(asphalt, {0.85, 0.85, 0.82}, mark * std::clamp(0.8 + wear, 0.0, 1.0));
}

Colour Asphalt(const StreetLayout& layout,
               const Eigen::Vector2d& place,
               double from_axis_m,
               double footprint_m,
               uint32_t seed,
               double contrast) {
  const double grain =
      contrast * FractalNoise(place.x(), place.y(), {1.5, 0.02}, footprint_m, seed);
  Colour colour = Colour(0.37, 0.37, 0.38) * (1.0 + 0.42 * grain);
  colour = Mix(colour, 0.68 * colour, contrast * PatchCover(place, footprint_m, seed + 20));
  colour = WithManhole(colour, place, footprint_m, seed + 30);
  return WithLaneMarks(colour, layout, place, from_axis_m, 0.8 * grain, footprint_m);
}

/// Slabs of half a metre, each of its own tone.
Colour Pavement(const Eigen::Vector2d& place, double footprint_m, uint32_t seed, double contrast) {
  constexpr double kSlab_m = 0.5;
  const double i = std::floor(place.x() / kSlab_m);
  const double j = std::floor(place.y() / kSlab_m);
  const double visible = contrast * std::clamp(2.0 - footprint_m / (0.4 * kSlab_m), 0.0, 1.0);
  const double tone = UniformOf(static_cast<int32_t>(i), static_cast<int32_t>(j), seed) - 0.5;
  const double grain =
      contrast * FractalNoise(place.x(), place.y(), {1.5, 0.02}, footprint_m, seed + 1);
  const double joint = std::max(CoverInterval(place.x() - i * kSlab_m, 0.0, 0.015, footprint_m),
                                CoverInterval(place.y() - j * kSlab_m, 0.0, 0.015, footprint_m));
  const Colour slab = Colour(0.60, 0.58, 0.55) * (1.0 + 0.22 * visible * tone + 0.34 * grain);
  return Mix(slab, 0.55 * slab, visible * joint);
}

}  // namespace

Colour GroundColour(const StreetLayout& layout,
                    const Eigen::Vector2d& place,
                    double footprint_m,
                    uint32_t seed,
                    double contrast) {
  constexpr double kKerbWidth_m = 0.18;
  const double d = layout.DistanceFromAxis(place);
  const double road = CoverInterval(d, Profile::kInnerKerb_m, Profile::kOuterKerb_m, footprint_m);
  const double kerb =
      CoverInterval(d, Profile::kInnerKerb_m - kKerbWidth_m, Profile::kInnerKerb_m, footprint_m) +
      CoverInterval(d, Profile::kOuterKerb_m, Profile::kOuterKerb_m + kKerbWidth_m, footprint_m);
  Colour colour = Pavement(place, footprint_m, seed + 1000, contrast);
  if (kerb > 0.0) {
    const double grain =
        contrast * FractalNoise(place.x(), place.y(), {2.0, 0.03}, footprint_m, seed + 2000);
    colour = Mix(colour, Colour::Constant(0.66 * (1.0 + 0.4 * grain)), kerb);
  }
  if (road == 0.0) return colour;
  return Mix(colour, Asphalt(layout, place, d, footprint_m, seed, contrast), road);
}

}  // namespace orbweave
