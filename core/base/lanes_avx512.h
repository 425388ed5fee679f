// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// False alarms from within the intrinsics of g++ 12 (GCC bug 105593), for all who include this.
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

/// Attributes of functions that are compiled for these lanes; of those that work on any lanes, too,
/// which are included after this.
#define ORBWEAVE_LANES __attribute__((target("avx512f,avx512bw,avx512dq"), always_inline)) inline

namespace orbweave::internal {

/// Sixteen lanes. Each operation rounds by itself: kernels that are written for lanes of any width
/// give the same bits with these as with others.
struct LanesAvx512 {
  static constexpr size_t kWidth = 16;
  using Floats = __m512;
  using Ints = __m512i;
  using Mask = __mmask16;

  ORBWEAVE_LANES static Floats Set(float a) { return _mm512_set1_ps(a); }
  ORBWEAVE_LANES static Floats Load(const float* from) { return _mm512_loadu_ps(from); }
  ORBWEAVE_LANES static void Store(float* to, Floats a) { _mm512_storeu_ps(to, a); }
  ORBWEAVE_LANES static Floats Add(Floats a, Floats b) { return _mm512_add_ps(a, b); }
  ORBWEAVE_LANES static Floats Sub(Floats a, Floats b) { return _mm512_sub_ps(a, b); }
  ORBWEAVE_LANES static Floats Mul(Floats a, Floats b) { return _mm512_mul_ps(a, b); }
  ORBWEAVE_LANES static Floats Div(Floats a, Floats b) { return _mm512_div_ps(a, b); }
  ORBWEAVE_LANES static Floats Max(Floats a, Floats b) { return _mm512_max_ps(a, b); }
  ORBWEAVE_LANES static Floats Min(Floats a, Floats b) { return _mm512_min_ps(a, b); }
  ORBWEAVE_LANES static Floats Sqrt(Floats a) { return _mm512_sqrt_ps(a); }
  ORBWEAVE_LANES static Floats Abs(Floats a) { return _mm512_abs_ps(a); }
  ORBWEAVE_LANES static Mask Less(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
  }
  ORBWEAVE_LANES static Mask And(Mask a, Mask b) { return static_cast<__mmask16>(a & b); }
  ORBWEAVE_LANES static Mask AndNot(Mask a, Mask b) { return static_cast<__mmask16>(~a & b); }
  ORBWEAVE_LANES static Floats Select(Mask mask, Floats yes, Floats no) {
    return _mm512_mask_blend_ps(mask, no, yes);
  }
  ORBWEAVE_LANES static Ints SelectInts(Mask mask, Ints yes, Ints no) {
    return _mm512_mask_blend_epi32(mask, no, yes);
  }
  ORBWEAVE_LANES static Ints SetInt(int32_t a) { return _mm512_set1_epi32(a); }
  ORBWEAVE_LANES static Ints LoadInts(const int32_t* from) {
    return _mm512_loadu_si512(reinterpret_cast<const __m512i*>(from));
  }
  ORBWEAVE_LANES static void StoreInts(int32_t* to, Ints a) {
    _mm512_storeu_si512(reinterpret_cast<__m512i*>(to), a);
  }
  ORBWEAVE_LANES static Ints Truncate(Floats a) { return _mm512_cvttps_epi32(a); }
  ORBWEAVE_LANES static Floats ToFloats(Ints a) { return _mm512_cvtepi32_ps(a); }
  ORBWEAVE_LANES static Ints AddInts(Ints a, Ints b) { return _mm512_add_epi32(a, b); }
  ORBWEAVE_LANES static Ints SubInts(Ints a, Ints b) { return _mm512_sub_epi32(a, b); }
  ORBWEAVE_LANES static Ints MulInts(Ints a, Ints b) { return _mm512_mullo_epi32(a, b); }
  ORBWEAVE_LANES static Ints Mul16(Ints a, Ints b) { return _mm512_mullo_epi16(a, b); }
  ORBWEAVE_LANES static Ints AndInts(Ints a, Ints b) { return _mm512_and_si512(a, b); }
  ORBWEAVE_LANES static Ints OrInts(Ints a, Ints b) { return _mm512_or_si512(a, b); }
  template <int kBits>
  ORBWEAVE_LANES static Ints ShiftRight(Ints a) {
    return _mm512_srai_epi32(a, kBits);
  }
  template <int kBits>
  ORBWEAVE_LANES static Ints ShiftLeft(Ints a) {
    return _mm512_slli_epi32(a, kBits);
  }
  ORBWEAVE_LANES static Ints Gather(const uint32_t* from, Ints index) {
    return _mm512_i32gather_epi32(index, from, 4);
  }
  ORBWEAVE_LANES static Ints SumBytePairs(Ints a, Ints b) { return _mm512_maddubs_epi16(a, b); }
  ORBWEAVE_LANES static Ints SumPairs(Ints a, Ints b) { return _mm512_madd_epi16(a, b); }
  ORBWEAVE_LANES static Floats Iota() {
    return _mm512_setr_ps(0.0F,
                          1.0F,
                          2.0F,
                          3.0F,
                          4.0F,
                          5.0F,
                          6.0F,
                          7.0F,
                          8.0F,
                          9.0F,
                          10.0F,
                          11.0F,
                          12.0F,
                          13.0F,
                          14.0F,
                          15.0F);
  }
  ORBWEAVE_LANES static Mask LessEqual(Floats a, Floats b) {
    return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ);
  }
  ORBWEAVE_LANES static Mask Or(Mask a, Mask b) { return static_cast<__mmask16>(a | b); }
  ORBWEAVE_LANES static uint32_t Bits(Mask a) { return a; }
  ORBWEAVE_LANES static Floats Gather(const float* from, Ints index) {
    return _mm512_i32gather_ps(index, from, 4);
  }
};

}  // namespace orbweave::internal
