// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace orbweave {

/// Share of the variance of a range that another map of the same place has in common with it: both
/// match the same pixels, on the same planes. Of what stands still on streets 11 and 12, errors of
/// two maps correlate by 0.41 to 0.53 on walls (`bench_depth --seed N --realistic --exact`).
inline constexpr float kSharedVariance = 0.5F;

/// Variance of the mean of so many ranges, each with the variance 1: c + (1 - c) / count.
inline constexpr float VarianceOfMean(float count) {
  return kSharedVariance + (1.0F - kSharedVariance) / count;
}

}  // namespace orbweave
