// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/features/nearest_two.h"
#include "core/scene/features.h"

/// The inside of FindNearestTwo and NearestInPlanes: what their kernels share.

namespace orbweave::internal {

constexpr size_t kLanes = 16;
/// Four neighbouring bytes of a descriptor: what one 32-bit lane multiplies at a time.
constexpr size_t kGroups = kDescriptorSize / 4;
constexpr size_t kBlockBytes = kLanes * kDescriptorSize;

/// 16 descriptors side by side, group after group: byte 4 (16 g + j) + k is byte 4 g + k of
/// descriptor j. One 64-byte load then feeds 16 dot products, and no sum runs across lanes.
struct alignas(64) DescriptorBlock {
  std::array<uint8_t, kBlockBytes> bytes{};
  std::array<int32_t, kLanes> sums{};   ///< of a descriptor's bytes
  std::array<int32_t, kLanes> norms{};  ///< of its squares; kNoDistance where the block is not full
};

/// Two smallest distances per lane and where the smallest was.
struct alignas(64) LaneState {
  std::array<int32_t, kLanes> best{};
  std::array<int32_t, kLanes> second{};
  std::array<int32_t, kLanes> index{};
};

/// Up to kRowsPerJob descriptors of the first set against all blocks of the second. Updates
/// `row_states` (a row's distances to descriptor j of any block go to lane j, the index is that of
/// the block) and `block_states` (one per block, the index is that of the row).
struct DistanceJob {
  const uint8_t* rows = nullptr;  ///< num_rows x kDescriptorSize
  size_t num_rows = 0;
  int32_t first_row = 0;
  const int32_t* row_norms = nullptr;
  std::span<const DescriptorBlock> blocks{};
  LaneState* row_states = nullptr;
  LaneState* block_states = nullptr;
};

constexpr size_t kRowsPerJob = 8;

/// One descriptor against those of some blocks that it is to be compared with: gives its two
/// nearest (descriptor j of block c has the index 16 c + j), and updates `block_states` as
/// DistanceJob does.
struct HeldJob {
  const uint8_t* row = nullptr;  ///< kDescriptorSize
  int32_t row_norm = 0;
  int32_t row_index = 0;
  std::span<const DescriptorBlock> blocks{};
  int32_t first_block = 0;            ///< index of blocks[0]
  const int32_t* held = nullptr;      ///< kLanes per block: 1 where to compare, 0 elsewhere
  LaneState* block_states = nullptr;  ///< of `blocks`
};

void UpdateNearestPortable(const DistanceJob& job);
[[nodiscard]] NearestTwo UpdateHeldPortable(const HeldJob& job);
#if defined(__x86_64__)
void UpdateNearestAvx2(const DistanceJob& job);
[[nodiscard]] NearestTwo UpdateHeldAvx2(const HeldJob& job);
void UpdateNearestAvx512Vnni(const DistanceJob& job);
[[nodiscard]] NearestTwo UpdateHeldAvx512Vnni(const HeldJob& job);
#endif

}  // namespace orbweave::internal
