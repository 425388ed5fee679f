// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/gaussian_taps.h"

#include <algorithm>
#include <cmath>

#include "core/base/status.h"

namespace orbweave::internal {
namespace {

constexpr double kReachSigmas = 3.0;
/// What the kernels are made for.
constexpr std::array<int, 5> kRadii = {4, 5, 6, 8, 10};

int RadiusFor(double sigma_px) {
  const auto radius = std::lower_bound(
      kRadii.begin(), kRadii.end(), static_cast<int>(std::ceil(kReachSigmas * sigma_px)));
  ORBWEAVE_CHECK(radius != kRadii.end());
  return *radius;
}

}  // namespace

GaussianTaps MakeGaussianTaps(double sigma_px) {
  GaussianTaps result{.radius = RadiusFor(sigma_px)};
  std::array<double, kMaxBlurRadius + 1> weights{};
  double sum = 0.0;
  for (int i = 0; i <= result.radius; ++i) {
    const double weight = std::exp(-0.5 * i * i / (sigma_px * sigma_px));
    weights[static_cast<size_t>(i)] = weight;
    sum += i == 0 ? weight : 2.0 * weight;
  }
  for (size_t i = 0; i < weights.size(); ++i) result.taps[i] = static_cast<float>(weights[i] / sum);
  return result;
}

}  // namespace orbweave::internal
