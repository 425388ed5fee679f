// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/random.h"

namespace orbweave {

/// Fills `sample` with different numbers of {0, ..., size-1}, each subset equally likely;
/// sample.size() <= size, and small: quadratic in its length.
void DrawSample(Random& random, uint32_t size, std::span<uint32_t> sample);

/// The numbers 0 ... size-1 in random order (Fisher and Yates).
[[nodiscard]] std::vector<uint32_t> ShuffledOrder(uint32_t size, uint64_t seed);

/// Trials after which a sample of `sample_size` inliers was drawn with probability `confidence`:
/// log(1 - confidence) / log(1 - share^sample_size), in [1, max_trials].
[[nodiscard]] int RequiredTrials(double inlier_share,
                                 size_t sample_size,
                                 double confidence,
                                 int max_trials);

}  // namespace orbweave
