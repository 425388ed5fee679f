// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/find_nearest_two.h"

#include <algorithm>

#include "core/base/status.h"
#include "core/features/distance_kernels.h"

namespace orbweave {
namespace {

using internal::DescriptorBlock;
using internal::DistanceJob;
using internal::kGroups;
using internal::kLanes;
using internal::kRowsAtOnce;
using internal::LaneState;

constexpr size_t kBytes = kDescriptorSize;

int32_t SquaredNorm(const uint8_t* descriptor) {
  int32_t sum = 0;
  for (size_t k = 0; k < kBytes; ++k) sum += descriptor[k] * descriptor[k];
  return sum;
}

std::vector<DescriptorBlock> PackBlocks(std::span<const uint8_t> descriptors) {
  const size_t count = descriptors.size() / kBytes;
  std::vector<DescriptorBlock> blocks((count + kLanes - 1) / kLanes);
  for (DescriptorBlock& block : blocks) block.norms.fill(kNoDistance);
  for (size_t i = 0; i < count; ++i) {
    DescriptorBlock& block = blocks[i / kLanes];
    const size_t lane = i % kLanes;
    const uint8_t* const descriptor = descriptors.data() + i * kBytes;
    for (size_t k = 0; k < kBytes; ++k) {
      block.bytes[4 * (kLanes * (k / 4) + lane) + k % 4] = descriptor[k];
      block.sums[lane] += descriptor[k];
    }
    block.norms[lane] = SquaredNorm(descriptor);
  }
  return blocks;
}

LaneState EmptyState() {
  LaneState state;
  state.best.fill(kNoDistance);
  state.second.fill(kNoDistance);
  return state;
}

/// The two nearest of all lanes of a row; lane j of block c is descriptor 16 c + j.
NearestTwo ReduceRow(const LaneState& state) {
  NearestTwo nearest;
  for (size_t j = 0; j < kLanes; ++j) {
    const auto index = static_cast<uint32_t>(state.index[j]) * static_cast<uint32_t>(kLanes) +
                       static_cast<uint32_t>(j);
    const bool better =
        state.best[j] < nearest.best || (state.best[j] == nearest.best && index < nearest.index);
    const int32_t loser = better ? nearest.best : state.best[j];
    nearest.second = std::min({nearest.second, loser, state.second[j]});
    if (better) {
      nearest.best = state.best[j];
      nearest.index = index;
    }
  }
  return nearest;
}

std::vector<NearestTwo> UnpackBlocks(const std::vector<LaneState>& states, size_t count) {
  std::vector<NearestTwo> nearest;
  for (size_t i = 0; i < count; ++i) {
    const LaneState& state = states[i / kLanes];
    const size_t lane = i % kLanes;
    nearest.push_back(
        {state.best[lane], state.second[lane], static_cast<uint32_t>(state.index[lane])});
  }
  return nearest;
}

using Kernel = void (*)(const DistanceJob&);

Kernel FunctionOf([[maybe_unused]] DistanceKernel kernel) {
#if defined(__x86_64__)
  if (kernel == DistanceKernel::kAvx2) return internal::UpdateNearestAvx2;
  if (kernel == DistanceKernel::kAvx512Vnni) return internal::UpdateNearestAvx512Vnni;
#endif
  return internal::UpdateNearestPortable;
}

}  // namespace

std::vector<DistanceKernel> AvailableDistanceKernels() {
  std::vector<DistanceKernel> kernels = {DistanceKernel::kPortable};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back(DistanceKernel::kAvx2);
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vnni")) {
    kernels.push_back(DistanceKernel::kAvx512Vnni);
  }
#endif
  return kernels;
}

NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a,
                                  std::span<const uint8_t> b,
                                  DistanceKernel kernel) {
  const Kernel update_nearest = FunctionOf(kernel);
  const std::vector<DescriptorBlock> blocks = PackBlocks(b);
  std::vector<LaneState> block_states(blocks.size(), EmptyState());
  NearestTwoBothWays nearest;
  const size_t num_a = a.size() / kBytes;
  for (size_t row = 0; row < num_a; row += kRowsAtOnce) {
    const size_t num_rows = std::min(kRowsAtOnce, num_a - row);
    std::array<LaneState, kRowsAtOnce> row_states;
    row_states.fill(EmptyState());
    std::array<int32_t, kRowsAtOnce> norms{};
    for (size_t r = 0; r < num_rows; ++r) norms[r] = SquaredNorm(a.data() + (row + r) * kBytes);
    update_nearest({.rows = a.data() + row * kBytes,
                    .num_rows = num_rows,
                    .first_row = static_cast<int32_t>(row),
                    .row_norms = norms.data(),
                    .blocks = blocks,
                    .row_states = row_states.data(),
                    .block_states = block_states.data()});
    for (size_t r = 0; r < num_rows; ++r) nearest.of_a.push_back(ReduceRow(row_states[r]));
  }
  nearest.of_b = UnpackBlocks(block_states, b.size() / kBytes);
  return nearest;
}

NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a, std::span<const uint8_t> b) {
  return FindNearestTwo(a, b, AvailableDistanceKernels().back());
}

}  // namespace orbweave
