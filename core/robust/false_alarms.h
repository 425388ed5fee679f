// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace orbweave {

/// Decimal logarithm of the expected number of models that k of n data fit by chance, when each
/// datum fits a wrong model with probability `chance` and `sample` data make a model:
///   NFA = num_tests (n - sample) C(n, k) C(k, sample) chance^(k - sample)
/// (Moisan and Stival, IJCV 2004). 0 for k <= sample: they fit by construction.
[[nodiscard]] double Log10FalseAlarms(
    size_t n, size_t k, size_t sample, double chance, size_t num_tests = 1);

/// log10 P(X >= count) for X ~ Poisson(mean), mean > 0. 0 for counts up to the mean.
[[nodiscard]] double Log10PoissonTail(size_t count, double mean);

}  // namespace orbweave
