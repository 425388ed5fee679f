// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

/// Attributes of functions that are compiled for these lanes; of those that work on any lanes, too,
/// which are included after this.
#define ORBWEAVE_LANES __attribute__((target("avx2"), always_inline)) inline

namespace orbweave::internal {

/// Eight lanes. Each operation rounds by itself: kernels that are written for lanes of any width
/// give the same bits with these as with others.
struct LanesAvx2 {
  static constexpr size_t kWidth = 8;
  using Floats = __m256;
  using Ints = __m256i;
  using Mask = __m256;

  ORBWEAVE_LANES static Floats Set(float a) { return _mm256_set1_ps(a); }
  ORBWEAVE_LANES static Floats Load(const float* from) { return _mm256_loadu_ps(from); }
  ORBWEAVE_LANES static void Store(float* to, Floats a) { _mm256_storeu_ps(to, a); }
  ORBWEAVE_LANES static Floats Add(Floats a, Floats b) { return _mm256_add_ps(a, b); }
  ORBWEAVE_LANES static Floats Sub(Floats a, Floats b) { return _mm256_sub_ps(a, b); }
  ORBWEAVE_LANES static Floats Mul(Floats a, Floats b) { return _mm256_mul_ps(a, b); }
  ORBWEAVE_LANES static Floats Div(Floats a, Floats b) { return _mm256_div_ps(a, b); }
  ORBWEAVE_LANES static Floats Max(Floats a, Floats b) { return _mm256_max_ps(a, b); }
  ORBWEAVE_LANES static Floats Min(Floats a, Floats b) { return _mm256_min_ps(a, b); }
  ORBWEAVE_LANES static Floats Sqrt(Floats a) { return _mm256_sqrt_ps(a); }
  ORBWEAVE_LANES static Floats Abs(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a); }
  ORBWEAVE_LANES static Mask Less(Floats a, Floats b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  ORBWEAVE_LANES static Mask And(Mask a, Mask b) { return _mm256_and_ps(a, b); }
  ORBWEAVE_LANES static Mask AndNot(Mask a, Mask b) { return _mm256_andnot_ps(a, b); }
  ORBWEAVE_LANES static Floats Select(Mask mask, Floats yes, Floats no) {
    return _mm256_blendv_ps(no, yes, mask);
  }
  ORBWEAVE_LANES static Ints SelectInts(Mask mask, Ints yes, Ints no) {
    return _mm256_castps_si256(
        _mm256_blendv_ps(_mm256_castsi256_ps(no), _mm256_castsi256_ps(yes), mask));
  }
  ORBWEAVE_LANES static Ints SetInt(int32_t a) { return _mm256_set1_epi32(a); }
  ORBWEAVE_LANES static Ints LoadInts(const int32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
  }
  ORBWEAVE_LANES static void StoreInts(int32_t* to, Ints a) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), a);
  }
  ORBWEAVE_LANES static Ints Truncate(Floats a) { return _mm256_cvttps_epi32(a); }
  ORBWEAVE_LANES static Floats ToFloats(Ints a) { return _mm256_cvtepi32_ps(a); }
  ORBWEAVE_LANES static Ints AddInts(Ints a, Ints b) { return _mm256_add_epi32(a, b); }
  ORBWEAVE_LANES static Ints SubInts(Ints a, Ints b) { return _mm256_sub_epi32(a, b); }
  ORBWEAVE_LANES static Ints MulInts(Ints a, Ints b) { return _mm256_mullo_epi32(a, b); }
  ORBWEAVE_LANES static Ints Mul16(Ints a, Ints b) { return _mm256_mullo_epi16(a, b); }
  ORBWEAVE_LANES static Ints AndInts(Ints a, Ints b) { return _mm256_and_si256(a, b); }
  ORBWEAVE_LANES static Ints OrInts(Ints a, Ints b) { return _mm256_or_si256(a, b); }
  template <int kBits>
  ORBWEAVE_LANES static Ints ShiftRight(Ints a) {
    return _mm256_srai_epi32(a, kBits);
  }
  template <int kBits>
  ORBWEAVE_LANES static Ints ShiftLeft(Ints a) {
    return _mm256_slli_epi32(a, kBits);
  }
  ORBWEAVE_LANES static Ints Gather(const uint32_t* from, Ints index) {
    return _mm256_i32gather_epi32(reinterpret_cast<const int*>(from), index, 4);
  }
  ORBWEAVE_LANES static Ints SumBytePairs(Ints a, Ints b) { return _mm256_maddubs_epi16(a, b); }
  ORBWEAVE_LANES static Ints SumPairs(Ints a, Ints b) { return _mm256_madd_epi16(a, b); }
  ORBWEAVE_LANES static Floats Iota() {
    return _mm256_setr_ps(0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F);
  }
  ORBWEAVE_LANES static Mask LessEqual(Floats a, Floats b) {
    return _mm256_cmp_ps(a, b, _CMP_LE_OQ);
  }
  ORBWEAVE_LANES static Mask Or(Mask a, Mask b) { return _mm256_or_ps(a, b); }
  ORBWEAVE_LANES static uint32_t Bits(Mask a) {
    return static_cast<uint32_t>(_mm256_movemask_ps(a));
  }
  ORBWEAVE_LANES static Floats Gather(const float* from, Ints index) {
    return _mm256_i32gather_ps(from, index, 4);
  }
};

}  // namespace orbweave::internal
