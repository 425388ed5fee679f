// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/noise_by_level.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace orbweave {
namespace {

constexpr size_t kLeastResponses = 500;
/// Lower quartile of |x| for x of variance 36, the filter's gain.
constexpr float kQuartile = 0.3186F * 6.0F;

}  // namespace

NoiseByLevel EstimateNoise(const GreyPanorama& panorama, float least, float most) {
  std::array<std::vector<int>, 8> responses;
  const int stride = panorama.Stride();
  for (int row = panorama.height_px / 4; row < 3 * panorama.height_px / 4; row += 2) {
    for (int column = 0; column < panorama.width_px; column += 2) {
      const uint8_t* const b = panorama.At(row, column);
      const uint8_t* const a = b - stride;
      const uint8_t* const c = b + stride;
      const int response =
          a[-1] + a[1] + c[-1] + c[1] - 2 * (a[0] + c[0] + b[-1] + b[1]) + 4 * b[0];
      if (*b == 0 || *b == 255) continue;  // clipped: no noise to be seen
      responses[*b / NoiseByLevel::kLevelsPerBin].push_back(std::abs(response));
    }
  }
  NoiseByLevel noise;
  noise.variances.fill(least);
  for (size_t bin = 0; bin < responses.size(); ++bin) {
    std::vector<int>& sizes = responses[bin];
    if (sizes.size() < kLeastResponses) continue;
    const auto quartile = sizes.begin() + static_cast<ptrdiff_t>(sizes.size() / 4);
    std::nth_element(sizes.begin(), quartile, sizes.end());
    const float sigma = static_cast<float>(*quartile) / kQuartile;
    noise.variances[bin] = std::clamp(sigma * sigma, least, most);
  }
  return noise;
}

}  // namespace orbweave
