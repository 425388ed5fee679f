// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "core/features/descriptor_blocks.h"
#include "core/features/distance_kernels.h"

namespace orbweave::internal {
namespace {

using WideDescriptor = std::array<int16_t, kDescriptorSize>;

/// A descriptor of a block, in a type whose products compilers vectorise.
WideDescriptor Unpack(const DescriptorBlock& block, size_t lane) {
  WideDescriptor row;
  for (size_t g = 0; g < kGroups; ++g) {
    for (size_t k = 0; k < 4; ++k) row[4 * g + k] = block.bytes[4 * (kLanes * g + lane) + k];
  }
  return row;
}

std::array<WideDescriptor, kLanes> Unpack(const DescriptorBlock& block) {
  std::array<WideDescriptor, kLanes> rows;
  for (size_t j = 0; j < kLanes; ++j) rows[j] = Unpack(block, j);
  return rows;
}

WideDescriptor Widen(const uint8_t* descriptor) {
  WideDescriptor wide;
  for (size_t k = 0; k < wide.size(); ++k) wide[k] = descriptor[k];
  return wide;
}

int32_t DotProduct(const WideDescriptor& a, const WideDescriptor& b) {
  int32_t sum = 0;
  for (size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum;
}

void Update(LaneState& state, size_t lane, int32_t distance, int32_t index) {
  const bool better = distance < state.best[lane];
  state.second[lane] = std::min(state.second[lane], better ? state.best[lane] : distance);
  state.index[lane] = better ? index : state.index[lane];
  state.best[lane] = better ? distance : state.best[lane];
}

}  // namespace

void UpdateNearestPortable(const DistanceJob& job) {
  for (size_t c = 0; c < job.blocks.size(); ++c) {
    const std::array<WideDescriptor, kLanes> columns = Unpack(job.blocks[c]);
    for (size_t r = 0; r < job.num_rows; ++r) {
      const WideDescriptor row = Widen(job.rows + r * kDescriptorSize);
      for (size_t j = 0; j < kLanes; ++j) {
        const int32_t norms = job.row_norms[r] + job.blocks[c].norms[j];
        const int32_t distance = norms - 2 * DotProduct(row, columns[j]);
        Update(job.row_states[r], j, distance, static_cast<int32_t>(c));
        Update(job.block_states[c], j, distance, job.first_row + static_cast<int32_t>(r));
      }
    }
  }
}

NearestTwo UpdateHeldPortable(const HeldJob& job) {
  LaneState row_state = EmptyState();
  const WideDescriptor row = Widen(job.row);
  for (size_t c = 0; c < job.blocks.size(); ++c) {
    const DescriptorBlock& block = job.blocks[c];
    for (size_t j = 0; j < kLanes; ++j) {
      if (job.held[c * kLanes + j] == 0) continue;
      const int32_t norms = job.row_norm + block.norms[j];
      const int32_t distance = norms - 2 * DotProduct(row, Unpack(block, j));
      Update(row_state, j, distance, job.first_block + static_cast<int32_t>(c));
      Update(job.block_states[c], j, distance, job.row_index);
    }
  }
  return ReduceRow(row_state);
}

}  // namespace orbweave::internal
