// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/distance_kernels.h"

#if defined(__x86_64__)

#include <immintrin.h>

#include <cstring>

#include "core/features/descriptor_blocks.h"

#define ORBWEAVE_AVX2 __attribute__((target("avx2")))
#define ORBWEAVE_AVX2_INLINE ORBWEAVE_AVX2 __attribute__((always_inline)) inline

namespace orbweave::internal {
namespace {

using WideRow = std::array<int16_t, kDescriptorSize>;

ORBWEAVE_AVX2_INLINE __m256i Load(const int32_t* from) {
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
}
ORBWEAVE_AVX2_INLINE void Store(int32_t* to, __m256i value) {
  _mm256_store_si256(reinterpret_cast<__m256i*>(to), value);
}

ORBWEAVE_AVX2_INLINE void Update(LaneState& state, size_t lane, __m256i distance, int32_t index) {
  const __m256i best = Load(&state.best[lane]);
  const __m256i better = _mm256_cmpgt_epi32(best, distance);
  const __m256i loser = _mm256_max_epi32(distance, best);
  Store(&state.best[lane], _mm256_min_epi32(distance, best));
  Store(&state.second[lane], _mm256_min_epi32(Load(&state.second[lane]), loser));
  Store(&state.index[lane],
        _mm256_blendv_epi8(Load(&state.index[lane]), _mm256_set1_epi32(index), better));
}

/// Rows that are multiplied with what is widened of a block at a time: their sums stay in
/// registers.
constexpr size_t kRowsTogether = 4;

/// Eight lanes of dot products of each row: 16-bit products of four descriptors at a time, whose
/// two half sums lie side by side until the end.
template <size_t kRows>
ORBWEAVE_AVX2_INLINE void MultiplyRows(const WideRow* rows,
                                       const uint8_t* block_bytes,
                                       __m256i* dots) {
  __m256i low[kRows];
  __m256i high[kRows];
  for (size_t r = 0; r < kRows; ++r) low[r] = high[r] = _mm256_setzero_si256();
  for (size_t g = 0; g < kGroups; ++g) {
    const auto* const b = reinterpret_cast<const __m128i*>(block_bytes + 4 * kLanes * g);
    const __m256i b_low = _mm256_cvtepu8_epi16(_mm_load_si128(b));
    const __m256i b_high = _mm256_cvtepu8_epi16(_mm_load_si128(b + 1));
    for (size_t r = 0; r < kRows; ++r) {
      int64_t a = 0;
      std::memcpy(&a, &rows[r][4 * g], 8);
      const __m256i wide_a = _mm256_set1_epi64x(a);
      low[r] = _mm256_add_epi32(low[r], _mm256_madd_epi16(wide_a, b_low));
      high[r] = _mm256_add_epi32(high[r], _mm256_madd_epi16(wide_a, b_high));
    }
  }
  for (size_t r = 0; r < kRows; ++r)
    dots[r] = _mm256_permute4x64_epi64(_mm256_hadd_epi32(low[r], high[r]), 0xD8);
}

ORBWEAVE_AVX2_INLINE WideRow Widen(const uint8_t* row) {
  WideRow wide;
  for (size_t k = 0; k < wide.size(); ++k) wide[k] = row[k];
  return wide;
}

/// Rows first_row ... first_row + kRows - 1 of the job against eight lanes of a block.
template <size_t kRows>
ORBWEAVE_AVX2_INLINE void UpdateRows(
    const DistanceJob& job, const WideRow* rows, size_t first_row, size_t c, size_t lane) {
  const DescriptorBlock& block = job.blocks[c];
  __m256i dots[kRows];
  MultiplyRows<kRows>(rows + first_row, &block.bytes[4 * lane], dots);
  const __m256i norms = Load(&block.norms[lane]);
  for (size_t k = 0; k < kRows; ++k) {
    const size_t r = first_row + k;
    const __m256i sum = _mm256_add_epi32(norms, _mm256_set1_epi32(job.row_norms[r]));
    const __m256i distance = _mm256_sub_epi32(sum, _mm256_slli_epi32(dots[k], 1));
    Update(job.row_states[r], lane, distance, static_cast<int32_t>(c));
    Update(job.block_states[c], lane, distance, job.first_row + static_cast<int32_t>(r));
  }
}

ORBWEAVE_AVX2_INLINE __m256i LoadUnaligned(const int32_t* from) {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

/// Eight lanes of a block, of which `held` is not zero everywhere.
ORBWEAVE_AVX2_INLINE void UpdateHeldLanes(
    const HeldJob& job, const WideRow& row, __m256i held, size_t c, size_t lane, LaneState& state) {
  const DescriptorBlock& block = job.blocks[c];
  __m256i dots;
  MultiplyRows<1>(&row, &block.bytes[4 * lane], &dots);
  const __m256i sum = _mm256_add_epi32(Load(&block.norms[lane]), _mm256_set1_epi32(job.row_norm));
  const __m256i is_held = _mm256_cmpgt_epi32(held, _mm256_setzero_si256());
  const __m256i distance = _mm256_blendv_epi8(
      _mm256_set1_epi32(kNoDistance), _mm256_sub_epi32(sum, _mm256_slli_epi32(dots, 1)), is_held);
  Update(state, lane, distance, job.first_block + static_cast<int32_t>(c));
  Update(job.block_states[c], lane, distance, job.row_index);
}

}  // namespace

ORBWEAVE_AVX2 NearestTwo UpdateHeldAvx2(const HeldJob& job) {
  LaneState state = EmptyState();
  const WideRow row = Widen(job.row);
  for (size_t c = 0; c < job.blocks.size(); ++c) {
    for (size_t lane = 0; lane < kLanes; lane += 8) {
      const __m256i held = LoadUnaligned(job.held + c * kLanes + lane);
      if (_mm256_testz_si256(held, held) == 0) UpdateHeldLanes(job, row, held, c, lane, state);
    }
  }
  return ReduceRow(state);
}

ORBWEAVE_AVX2 void UpdateNearestAvx2(const DistanceJob& job) {
  std::array<WideRow, kRowsPerJob> rows;
  for (size_t r = 0; r < job.num_rows; ++r) rows[r] = Widen(job.rows + r * kDescriptorSize);
  for (size_t c = 0; c < job.blocks.size(); ++c) {
    for (size_t lane = 0; lane < kLanes; lane += 8) {
      size_t r = 0;
      for (; r + kRowsTogether <= job.num_rows; r += kRowsTogether)
        UpdateRows<kRowsTogether>(job, rows.data(), r, c, lane);
      for (; r < job.num_rows; ++r) UpdateRows<1>(job, rows.data(), r, c, lane);
    }
  }
}

}  // namespace orbweave::internal

#endif
