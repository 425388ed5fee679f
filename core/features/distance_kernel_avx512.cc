// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/distance_kernels.h"

#if defined(__x86_64__)

// False alarms from within the intrinsics of g++ 12 (GCC bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

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

/// A row whose bytes are those of a descriptor minus 128, as UpdateBlock multiplies them.
struct alignas(64) SignedRow {
  std::array<uint8_t, kDescriptorSize> bytes;
};

ORBWEAVE_AVX512_INLINE SignedRow MakeSigned(const uint8_t* row) {
  SignedRow result;
  const __m512i flip = _mm512_set1_epi8(static_cast<char>(0x80));
  for (size_t k = 0; k < kDescriptorSize; k += 64)
    _mm512_store_si512(&result.bytes[k], _mm512_xor_si512(_mm512_loadu_si512(row + k), flip));
  return result;
}

/// Blocks c ... c + kBlocks - 1 of the job.
template <size_t kBlocks>
ORBWEAVE_AVX512_INLINE void UpdateHeldBlocks(const HeldJob& job,
                                             const SignedRow& row,
                                             size_t c,
                                             State& row_state) {
  __m512i dots[kBlocks];
  for (size_t k = 0; k < kBlocks; ++k)
    dots[k] = _mm512_slli_epi32(_mm512_load_si512(job.blocks[c + k].sums.data()), 7);
#pragma GCC unroll 8
  for (size_t g = 0; g < kGroups; ++g) {
    int32_t a = 0;
    std::memcpy(&a, &row.bytes[4 * g], 4);
    const __m512i signed_a = _mm512_set1_epi32(a);
    for (size_t k = 0; k < kBlocks; ++k) {
      const __m512i b = _mm512_load_si512(&job.blocks[c + k].bytes[4 * kLanes * g]);
      dots[k] = _mm512_dpbusd_epi32(dots[k], b, signed_a);
    }
  }
  for (size_t k = 0; k < kBlocks; ++k) {
    const __m512i norms = _mm512_load_si512(job.blocks[c + k].norms.data());
    const __m512i sum = _mm512_add_epi32(norms, _mm512_set1_epi32(job.row_norm));
    const __m512i held = _mm512_loadu_si512(job.held + (c + k) * kLanes);
    const __m512i distance = _mm512_mask_sub_epi32(_mm512_set1_epi32(kNoDistance),
                                                   _mm512_test_epi32_mask(held, held),
                                                   sum,
                                                   _mm512_slli_epi32(dots[k], 1));
    row_state = Updated(row_state, distance, job.first_block + static_cast<int32_t>(c + k));
    LaneState& block_state = job.block_states[c + k];
    Store(Updated(Load(block_state), distance, job.row_index), block_state);
  }
}

/// The two nearest of all lanes of a row.
ORBWEAVE_AVX512_INLINE NearestTwo Reduce(const State& state) {
  const int32_t best = _mm512_reduce_min_epi32(state.best);
  if (best == kNoDistance) return {};
  const __m512i lanes = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  const __m512i indices = _mm512_add_epi32(_mm512_slli_epi32(state.index, 4), lanes);
  const __mmask16 are_best = _mm512_cmpeq_epi32_mask(state.best, _mm512_set1_epi32(best));
  const int32_t index = _mm512_mask_reduce_min_epi32(are_best, indices);
  const __mmask16 is_winner =
      _mm512_mask_cmpeq_epi32_mask(are_best, indices, _mm512_set1_epi32(index));
  const __m512i others = _mm512_mask_mov_epi32(state.best, is_winner, state.second);
  const int32_t second = _mm512_reduce_min_epi32(_mm512_min_epi32(others, state.second));
  return {best, second, static_cast<uint32_t>(index)};
}

}  // namespace

ORBWEAVE_AVX512 NearestTwo UpdateHeldAvx512Vnni(const HeldJob& job) {
  const SignedRow row = MakeSigned(job.row);
  const __m512i far = _mm512_set1_epi32(kNoDistance);
  State row_state{far, far, _mm512_setzero_si512()};
  size_t c = 0;
  for (; c + 2 <= job.blocks.size(); c += 2) UpdateHeldBlocks<2>(job, row, c, row_state);
  if (c < job.blocks.size()) UpdateHeldBlocks<1>(job, row, c, row_state);
  return Reduce(row_state);
}

void UpdateNearestAvx512Vnni(const DistanceJob& job) {
  if (job.num_rows == kRowsPerJob) return UpdateAllBlocks<kRowsPerJob>(job);
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
