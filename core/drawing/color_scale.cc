// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/drawing/color_scale.h"

#include <array>
#include <cmath>

namespace orbweave {
namespace {

constexpr Rgb kSkyBlue = {86, 180, 233};
constexpr Rgb kYellow = {240, 228, 66};
constexpr Rgb kVermillion = {213, 94, 0};
constexpr std::array<Rgb, 7> kPalette = {{{230, 159, 0},
                                          kSkyBlue,
                                          {0, 200, 140},
                                          kYellow,
                                          {90, 140, 255},
                                          {255, 110, 40},
                                          {230, 140, 200}}};

Rgb Between(const Rgb& low, const Rgb& high, double share) {
  const auto mix = [share](uint8_t from, uint8_t to) {
    return static_cast<uint8_t>(std::lround(from + share * (to - from)));
  };
  return {mix(low.r, high.r), mix(low.g, high.g), mix(low.b, high.b)};
}

}  // namespace

Rgb ColorOnScale(double share) {
  if (!(share > 0.0)) return kSkyBlue;
  if (share >= 1.0) return kVermillion;
  return share < 0.5 ? Between(kSkyBlue, kYellow, 2.0 * share)
                     : Between(kYellow, kVermillion, 2.0 * share - 1.0);
}

Rgb ColorOfNumber(size_t number) { return kPalette[number % kPalette.size()]; }

}  // namespace orbweave
