// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/match_kernel.h"

#include <algorithm>
#include <cstdlib>

#include "core/dense/match_kernels.h"

namespace orbweave {
namespace {

using Shorts = std::array<int16_t, kMatchLanes>;

/// In 1/64: a tap counts less the farther it is from the middle.
int16_t SpatialWeight(int row, int column) {
  const int squared = row * row + column * column;
  return static_cast<int16_t>(std::max(16, 64 - squared));
}

void LoadTap(const uint8_t* from, Shorts& levels) {
  for (size_t k = 0; k < kMatchLanes; ++k) levels[k] = from[2 * k];
}

void WeighTap(const Shorts& levels, const Shorts& middle, int16_t spatial, Shorts& weights) {
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const auto difference = static_cast<int16_t>(levels[k] - middle[k]);
    const auto size = static_cast<int16_t>(difference < 0 ? -difference : difference);
    const auto range = static_cast<int16_t>(std::max<int16_t>(static_cast<int16_t>(64 - size), 8));
    weights[k] = static_cast<int16_t>((range * spatial) >> 6);
  }
}

int32_t Pair(int low, int high) {
  return (low & 0xFFFF) | static_cast<int32_t>(static_cast<uint32_t>(high) << 16);
}

}  // namespace

void PreparePatches(const uint8_t* middle, int stride, ReferencePatches& patches) {
  Shorts centre;
  LoadTap(middle, centre);
  LaneInts sum_w{};
  LaneInts sum_wr{};
  LaneInts sum_wrr{};
  size_t pair = 0;
  for (int row = -kPatchRadius_px; row <= kPatchRadius_px; row += 2) {
    for (int column = -kPatchRadius_px; column < kPatchRadius_px; column += 4, ++pair) {
      const uint8_t* const tap = middle + row * stride + column;
      Shorts r0;
      Shorts r1;
      Shorts w0;
      Shorts w1;
      LoadTap(tap, r0);
      LoadTap(tap + 2, r1);
      WeighTap(r0, centre, SpatialWeight(row, column), w0);
      WeighTap(r1, centre, SpatialWeight(row, column + 2), w1);
      for (size_t k = 0; k < kMatchLanes; ++k) {
        const int a = w0[k] * r0[k];
        const int b = w1[k] * r1[k];
        patches.weights[pair][k] = Pair(w0[k], w1[k]);
        patches.weighted[pair][k] = Pair(a, b);
        sum_w[k] += w0[k] + w1[k];
        sum_wr[k] += a + b;
        sum_wrr[k] += a * r0[k] + b * r1[k];
      }
    }
  }
  for (size_t k = 0; k < kMatchLanes; ++k) {
    const auto w = static_cast<float>(sum_w[k]);
    const auto wr = static_cast<float>(sum_wr[k]);
    patches.weight_sum[k] = w;
    patches.mean[k] = wr / w;
    patches.scatter[k] = static_cast<float>(static_cast<double>(sum_wrr[k]) -
                                            static_cast<double>(sum_wr[k]) * sum_wr[k] / sum_w[k]);
  }
}

std::vector<MatchKernel> AvailableMatchKernels() {
  std::vector<MatchKernel> kernels = {MatchKernel::kPortable};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back(MatchKernel::kAvx2);
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq"))
    kernels.push_back(MatchKernel::kAvx512);
#endif
  return kernels;
}

MatchFunction MatchFunctionOf(MatchKernel kernel) {
#if defined(__x86_64__)
  if (kernel == MatchKernel::kAvx512) return internal::MatchAvx512;
  if (kernel == MatchKernel::kAvx2) return internal::MatchAvx2;
#endif
  (void)kernel;
  return internal::MatchPortable;
}

}  // namespace orbweave
