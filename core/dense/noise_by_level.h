// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/dense/grey_panorama.h"

namespace orbweave {

/// Variance of an image's noise, in squared grey levels, by the brightness of what it is on.
struct NoiseByLevel {
  static constexpr int kLevelsPerBin = 32;
  std::array<float, 8> variances{};

  [[nodiscard]] float At(float level) const {
    const int bin = static_cast<int>(level) / kLevelsPerBin;
    return variances[static_cast<size_t>(bin < 0 ? 0 : bin > 7 ? 7 : bin)];
  }
};

/// From the responses of the filter [1 -2 1]' [1 -2 1], which sees no gradients (Immerkaer: Fast
/// noise variance estimation, CVIU 1996), between 45 degrees above and below the horizon. Their
/// lower quartile is taken, since texture makes the others larger. Between `least` and `most`.
[[nodiscard]] NoiseByLevel EstimateNoise(const GreyPanorama& panorama, float least, float most);

}  // namespace orbweave
