// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/descriptor_distance.h"

#include "core/scene/features.h"

namespace orbweave {

// Compiled for two instruction sets; the loader takes the better one that the processor has.
__attribute__((target_clones("avx2", "default"))) int32_t SquaredDistance(const uint8_t* a,
                                                                          const uint8_t* b) {
  int32_t sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) {
    const auto difference = static_cast<int16_t>(a[k] - b[k]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace orbweave
