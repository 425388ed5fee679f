// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/descriptor_distance.h"

#include "core/features/for_each_processor.h"
#include "core/scene/features.h"

namespace orbweave {
namespace {

[[gnu::always_inline]] inline int32_t Distance(const uint8_t* a, const uint8_t* b) {
  int32_t sum = 0;
  for (int k = 0; k < kDescriptorSize; ++k) {
    const auto difference = static_cast<int16_t>(a[k] - b[k]);
    sum += difference * difference;
  }
  return sum;
}

}  // namespace

ORBWEAVE_FOR_EACH_PROCESSOR int32_t SquaredDistance(const uint8_t* a, const uint8_t* b) {
  return Distance(a, b);
}

ORBWEAVE_FOR_EACH_PROCESSOR void SquaredDistances(const uint8_t* a,
                                                  const uint8_t* b,
                                                  std::span<const uint32_t> rows,
                                                  int32_t* distances) {
  for (size_t k = 0; k < rows.size(); ++k)
    distances[k] = Distance(a, b + size_t{rows[k]} * kDescriptorSize);
}

}  // namespace orbweave
