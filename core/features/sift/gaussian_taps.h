// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/features/sift/sift_kernels.h"

namespace orbweave::internal {

/// Half of a symmetric filter of sum one: tap i belongs to the pixels i to either side.
struct GaussianTaps {
  std::array<float, kMaxBlurRadius + 1> taps{};
  int radius = 0;
};

/// Gaussian of a standard deviation up to a third of kMaxBlurRadius, cut at three of them.
[[nodiscard]] GaussianTaps MakeGaussianTaps(double sigma_px);

}  // namespace orbweave::internal
