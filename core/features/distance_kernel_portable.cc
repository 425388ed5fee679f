// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <algorithm>

#include "core/features/distance_kernels.h"

namespace orbweave::internal {
namespace {

std::array<int32_t, kLanes> DotProducts(const uint8_t* row, const DescriptorBlock& block) {
  std::array<int32_t, kLanes> dots{};
  for (size_t g = 0; g < kGroups; ++g) {
    for (size_t j = 0; j < kLanes; ++j) {
      const uint8_t* const group = &block.bytes[4 * (kLanes * g + j)];
      for (size_t k = 0; k < 4; ++k) dots[j] += row[4 * g + k] * group[k];
    }
  }
  return dots;
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
    const DescriptorBlock& block = job.blocks[c];
    for (size_t r = 0; r < job.num_rows; ++r) {
      const std::array<int32_t, kLanes> dots = DotProducts(job.rows + r * kDescriptorSize, block);
      for (size_t j = 0; j < kLanes; ++j) {
        const int32_t distance = job.row_norms[r] + block.norms[j] - 2 * dots[j];
        Update(job.row_states[r], j, distance, static_cast<int32_t>(c));
        Update(job.block_states[c], j, distance, job.first_row + static_cast<int32_t>(r));
      }
    }
  }
}

}  // namespace orbweave::internal
