// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/features/distance_kernels.h"
#include "core/features/nearest_two.h"

/// What is made ready for the kernels of distances, and read from what they leave.

namespace orbweave::internal {

[[nodiscard]] int32_t SquaredNorm(const uint8_t* descriptor);

/// Descriptors side by side, in the order given; lanes of the last block that are left over have
/// the norm kNoDistance.
[[nodiscard]] std::vector<DescriptorBlock> PackBlocks(std::span<const uint8_t> descriptors);

/// The same of descriptors order[0], order[1], ...
[[nodiscard]] std::vector<DescriptorBlock> PackBlocks(std::span<const uint8_t> descriptors,
                                                      std::span<const uint32_t> order);

/// Nothing seen.
[[nodiscard]] LaneState EmptyState();

/// The two nearest of all lanes of a row; lane j of block c is descriptor 16 c + j.
[[nodiscard]] NearestTwo ReduceRow(const LaneState& state);

/// For each of `count` descriptors in blocks the nearest row.
[[nodiscard]] std::vector<NearestTwo> UnpackBlocks(std::span<const LaneState> states, size_t count);

}  // namespace orbweave::internal
