// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/features/sift/sift_kernels.h"

namespace orbweave {

/// Ways to compute the same numbers.
enum class SiftKernel { kPortable, kAvx2, kAvx512 };

/// Those that this processor can run, slowest first.
[[nodiscard]] std::vector<SiftKernel> AvailableSiftKernels();
[[nodiscard]] const internal::SiftKernels& SiftKernelsOf(SiftKernel kernel);

}  // namespace orbweave
