// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/find_nearest_two.h"

#include <algorithm>

#include "core/features/descriptor_blocks.h"
#include "core/features/distance_kernels.h"

namespace orbweave {
namespace {

using internal::DescriptorBlock;
using internal::DistanceJob;
using internal::kRowsPerJob;
using internal::LaneState;

constexpr size_t kBytes = kDescriptorSize;

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
  const std::vector<DescriptorBlock> blocks = internal::PackBlocks(b);
  std::vector<LaneState> block_states(blocks.size(), internal::EmptyState());
  NearestTwoBothWays nearest;
  const size_t num_a = a.size() / kBytes;
  for (size_t row = 0; row < num_a; row += kRowsPerJob) {
    const size_t num_rows = std::min(kRowsPerJob, num_a - row);
    std::array<LaneState, kRowsPerJob> row_states;
    row_states.fill(internal::EmptyState());
    std::array<int32_t, kRowsPerJob> norms{};
    for (size_t r = 0; r < num_rows; ++r)
      norms[r] = internal::SquaredNorm(a.data() + (row + r) * kBytes);
    update_nearest({.rows = a.data() + row * kBytes,
                    .num_rows = num_rows,
                    .first_row = static_cast<int32_t>(row),
                    .row_norms = norms.data(),
                    .blocks = blocks,
                    .row_states = row_states.data(),
                    .block_states = block_states.data()});
    for (size_t r = 0; r < num_rows; ++r)
      nearest.of_a.push_back(internal::ReduceRow(row_states[r]));
  }
  nearest.of_b = internal::UnpackBlocks(block_states, b.size() / kBytes);
  return nearest;
}

NearestTwoBothWays FindNearestTwo(std::span<const uint8_t> a, std::span<const uint8_t> b) {
  return FindNearestTwo(a, b, AvailableDistanceKernels().back());
}

}  // namespace orbweave
