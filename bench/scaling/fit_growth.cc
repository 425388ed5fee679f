// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "bench/scaling/fit_growth.h"

#include <cmath>

namespace orbweave {

std::optional<PowerLaw> FitGrowth(const std::vector<std::pair<double, double>>& points) {
  double n = 0.0;
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const auto& [x, y] : points) {
    if (!(x > 0.0 && y > 0.0)) continue;
    n += 1.0;
    mean_x += (std::log(x) - mean_x) / n;
    mean_y += (std::log(y) - mean_y) / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const auto& [x, y] : points) {
    if (!(x > 0.0 && y > 0.0)) continue;
    const double dx = std::log(x) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y) - mean_y);
  }
  constexpr double kSameX = 1e-12;  // rounding of a mean of equal logarithms
  if (xx < kSameX) return std::nullopt;
  const double exponent = xy / xx;
  return PowerLaw{std::exp(mean_y - exponent * mean_x), exponent};
}

}  // namespace orbweave
