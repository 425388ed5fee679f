// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/features/nearest_two.h"

namespace orbweave {

/// Ways to compute the same integers.
enum class DistanceKernel { kPortable, kAvx2, kAvx512Vnni };

/// Those that this processor can run, slowest first.
[[nodiscard]] std::vector<DistanceKernel> AvailableDistanceKernels();

/// All squared distances between two sets of kDescriptorSize-byte descriptors, computed once and
/// used in both directions: |a|^2 + |b|^2 - 2 a.b in 32-bit integers, so that every kernel gives
/// the same result on every machine. Either set may be empty.
[[nodiscard]] NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a,
                                                std::span<const uint8_t> b,
                                                DistanceKernel kernel);

/// The same with the fastest kernel of this processor.
[[nodiscard]] NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a,
                                                std::span<const uint8_t> b);

}  // namespace orbweave
