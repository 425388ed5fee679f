// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/descriptor_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/base/for_each_processor.h"

namespace orbweave::internal {
namespace {

constexpr size_t kBytes = kDescriptorSize;

struct Sums {
  int32_t bytes = 0;
  int32_t squares = 0;
};

/// In a type whose products compilers vectorise.
ORBWEAVE_FOR_EACH_PROCESSOR Sums SumsOf(const uint8_t* descriptor) {
  std::array<int16_t, kBytes> wide;
  for (size_t k = 0; k < kBytes; ++k) wide[k] = descriptor[k];
  constexpr int16_t kOne = 1;
  Sums sums;
  for (size_t k = 0; k < kBytes; ++k) {
    sums.bytes += wide[k] * kOne;
    sums.squares += wide[k] * wide[k];
  }
  return sums;
}

void Put(const uint8_t* descriptor, size_t lane, DescriptorBlock& block) {
  for (size_t g = 0; g < kGroups; ++g)
    std::memcpy(&block.bytes[4 * (kLanes * g + lane)], descriptor + 4 * g, 4);
  const Sums sums = SumsOf(descriptor);
  block.sums[lane] = sums.bytes;
  block.norms[lane] = sums.squares;
}

template <typename DescriptorOf>
std::vector<DescriptorBlock> Pack(size_t count, const DescriptorOf& descriptor_of) {
  std::vector<DescriptorBlock> blocks((count + kLanes - 1) / kLanes);
  if (!blocks.empty()) blocks.back().norms.fill(kNoDistance);
  for (size_t i = 0; i < count; ++i) Put(descriptor_of(i), i % kLanes, blocks[i / kLanes]);
  return blocks;
}

}  // namespace

int32_t SquaredNorm(const uint8_t* descriptor) { return SumsOf(descriptor).squares; }

std::vector<DescriptorBlock> PackBlocks(std::span<const uint8_t> descriptors) {
  return Pack(descriptors.size() / kBytes,
              [&](size_t i) { return descriptors.data() + i * kBytes; });
}

std::vector<DescriptorBlock> PackBlocks(std::span<const uint8_t> descriptors,
                                        std::span<const uint32_t> order) {
  return Pack(order.size(),
              [&](size_t i) { return descriptors.data() + size_t{order[i]} * kBytes; });
}

LaneState EmptyState() {
  LaneState state;
  state.best.fill(kNoDistance);
  state.second.fill(kNoDistance);
  return state;
}

ORBWEAVE_FOR_EACH_PROCESSOR NearestTwo ReduceRow(const LaneState& state) {
  constexpr auto kNumLanes = static_cast<int32_t>(kLanes);
  int32_t best = kNoDistance;
  for (size_t j = 0; j < kLanes; ++j) best = std::min(best, state.best[j]);
  int32_t winner = INT32_MAX;
  for (int32_t j = 0; j < kNumLanes; ++j) {
    const int32_t index = state.index[j] * kNumLanes + j;
    winner = std::min(winner, state.best[j] == best ? index : INT32_MAX);
  }
  int32_t second = kNoDistance;
  for (int32_t j = 0; j < kNumLanes; ++j) {
    const int32_t other = j == winner % kNumLanes ? kNoDistance : state.best[j];
    second = std::min({second, other, state.second[j]});
  }
  return {best, second, best == kNoDistance ? 0U : static_cast<uint32_t>(winner)};
}

std::vector<NearestTwo> UnpackBlocks(std::span<const LaneState> states, size_t count) {
  std::vector<NearestTwo> nearest;
  nearest.reserve(count);
  for (size_t i = 0; i < count; ++i) {
    const LaneState& state = states[i / kLanes];
    const size_t lane = i % kLanes;
    nearest.push_back(
        {state.best[lane], state.second[lane], static_cast<uint32_t>(state.index[lane])});
  }
  return nearest;
}

}  // namespace orbweave::internal
