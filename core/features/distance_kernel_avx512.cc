// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/distance_kernels.h"

#if defined(__x86_64__)

// False alarms from within the intrinsics of g++ 12 (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"

#include <immintrin.h>

#include <cstring>

#define ORBWEAVE_AVX512 __attribute__((target("avx512f,avx512bw,avx512vnni")))
#define ORBWEAVE_AVX512_INLINE ORBWEAVE_AVX512 __attribute__((always_inline)) inline

namespace orbweave::internal {
namespace {

struct State {
  __m512i best;
  __m512i second;
  __m512i index;
};

ORBWEAVE_AVX512_INLINE State Load(const LaneState& state) {
  return {_mm512_load_si512(state.best.data()),
          _mm512_load_si512(state.second.data()),
          _mm512_load_si512(state.index.data())};
}

ORBWEAVE_AVX512_INLINE void Store(const State& from, LaneState& state) {
  _mm512_store_si512(state.best.data(), from.best);
  _mm512_store_si512(state.second.data(), from.second);
  _mm512_store_si512(state.index.data(), from.index);
}

ORBWEAVE_AVX512_INLINE State Updated(const State& state, __m512i distance, int32_t index) {
  const __mmask16 better = _mm512_cmplt_epi32_mask(distance, state.best);
  const __m512i loser = _mm512_max_epi32(distance, state.best);
  return {_mm512_min_epi32(distance, state.best),
          _mm512_min_epi32(state.second, loser),
          _mm512_mask_set1_epi32(state.index, better, index)};
}

/// vpdpbusd multiplies unsigned by signed bytes: a.b = (a - 128).b + 128 sum(b).
template <size_t kRows>
ORBWEAVE_AVX512_INLINE void UpdateBlock(const DistanceJob& job, size_t c) {
  const DescriptorBlock& block = job.blocks[c];
  const __m512i offset = _mm512_slli_epi32(_mm512_load_si512(block.sums.data()), 7);
  __m512i dots[kRows];
  for (size_t r = 0; r < kRows; ++r) dots[r] = offset;
  for (size_t g = 0; g < kGroups; ++g) {
    const __m512i b = _mm512_load_si512(&block.bytes[4 * kLanes * g]);
    for (size_t r = 0; r < kRows; ++r) {
      uint32_t a = 0;
      std::memcpy(&a, job.rows + r * kDescriptorSize + 4 * g, 4);
      const __m512i signed_a = _mm512_set1_epi32(static_cast<int32_t>(a ^ 0x80808080U));
      dots[r] = _mm512_dpbusd_epi32(dots[r], b, signed_a);
    }
  }
  const __m512i norms = _mm512_load_si512(block.norms.data());
  State block_state = Load(job.block_states[c]);
  for (size_t r = 0; r < kRows; ++r) {
    const __m512i sum = _mm512_add_epi32(norms, _mm512_set1_epi32(job.row_norms[r]));
    const __m512i distance = _mm512_sub_epi32(sum, _mm512_slli_epi32(dots[r], 1));
    const State row_state = Load(job.row_states[r]);
    Store(Updated(row_state, distance, static_cast<int32_t>(c)), job.row_states[r]);
    block_state = Updated(block_state, distance, job.first_row + static_cast<int32_t>(r));
  }
  Store(block_state, job.block_states[c]);
}

template <size_t kRows>
ORBWEAVE_AVX512 void UpdateAllBlocks(const DistanceJob& job) {
  for (size_t c = 0; c < job.blocks.size(); ++c) UpdateBlock<kRows>(job, c);
}

}  // namespace

void UpdateNearestAvx512Vnni(const DistanceJob& job) {
  if (job.num_rows == kRowsAtOnce) return UpdateAllBlocks<kRowsAtOnce>(job);
  DistanceJob one = job;
  one.num_rows = 1;
  for (size_t r = 0; r < job.num_rows; ++r) {
    one.rows = job.rows + r * kDescriptorSize;
    one.first_row = job.first_row + static_cast<int32_t>(r);
    one.row_norms = job.row_norms + r;
    one.row_states = job.row_states + r;
    UpdateAllBlocks<1>(one);
  }
}

}  // namespace orbweave::internal

#endif
