// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

namespace orbweave {

/// Squared distance of two descriptors of kDescriptorSize bytes. Integers: the same on every
/// machine, whichever instructions the processor has.
[[nodiscard]] int32_t SquaredDistance(const uint8_t* a, const uint8_t* b);

/// distances[k] = SquaredDistance(a, descriptor rows[k] of those at `b`).
void SquaredDistances(const uint8_t* a,
                      const uint8_t* b,
                      std::span<const uint32_t> rows,
                      int32_t* distances);

}  // namespace orbweave
