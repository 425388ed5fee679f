// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace orbweave {

/// Squared distance of two descriptors of kDescriptorSize bytes. Integers: the same on every
/// machine, whichever instructions the processor has.
[[nodiscard]] int32_t SquaredDistance(const uint8_t* a, const uint8_t* b);

}  // namespace orbweave
