// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/synthetic/noise.h"

#include <algorithm>
#include <cmath>

namespace orbweave {
namespace {

double Fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

}  // namespace

double ValueNoise(double u, double v, uint32_t seed) {
  const double u0 = std::floor(u);
  const double v0 = std::floor(v);
  const auto i = static_cast<int32_t>(u0);
  const auto j = static_cast<int32_t>(v0);
  const double a = Fade(u - u0);
  const double b = Fade(v - v0);
  const double low = std::lerp(UniformOf(i, j, seed), UniformOf(i + 1, j, seed), a);
  const double high = std::lerp(UniformOf(i, j + 1, seed), UniformOf(i + 1, j + 1, seed), a);
  return 2.0 * std::lerp(low, high, b) - 1.0;
}

double FractalNoise(double u, double v, const NoiseBand& band, double footprint_m, uint32_t seed) {
  constexpr double kSumOfEqualOctaves = 0.45;
  double sum = 0.0;
  for (double length_m = band.longest_m; length_m >= band.shortest_m; length_m *= 0.5) {
    const double weight = std::clamp((length_m / footprint_m - 1.5) / 1.5, 0.0, 1.0);
    if (weight == 0.0) break;
    sum += weight * ValueNoise(u / length_m, v / length_m, ++seed);
  }
  return kSumOfEqualOctaves * sum;
}

}  // namespace orbweave
