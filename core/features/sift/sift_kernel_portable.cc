// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <cstring>

#include "core/features/sift/sift_kernels.h"

#define ORBWEAVE_LANES __attribute__((always_inline)) inline
#include "core/features/sift/sift_lanes.h"

namespace orbweave::internal {
namespace {

/// Four lanes by the compiler's own vectors: SSE2, NEON, or whatever there is.
struct LanesPortable {
  static constexpr size_t kWidth = 4;
  using Floats = float __attribute__((vector_size(16)));
  using Ints = int32_t __attribute__((vector_size(16)));
  using Mask = Ints;

  ORBWEAVE_LANES static Floats Set(float a) { return Floats{a, a, a, a}; }
  ORBWEAVE_LANES static Ints SetInt(int32_t a) { return Ints{a, a, a, a}; }
  ORBWEAVE_LANES static Floats Iota() { return Floats{0.0F, 1.0F, 2.0F, 3.0F}; }
  ORBWEAVE_LANES static Floats Load(const float* from) {
    Floats a;
    std::memcpy(&a, from, sizeof(a));
    return a;
  }
  ORBWEAVE_LANES static void Store(float* to, Floats a) { std::memcpy(to, &a, sizeof(a)); }
  ORBWEAVE_LANES static void StoreInts(int32_t* to, Ints a) { std::memcpy(to, &a, sizeof(a)); }
  ORBWEAVE_LANES static Floats Add(Floats a, Floats b) { return a + b; }
  ORBWEAVE_LANES static Floats Sub(Floats a, Floats b) { return a - b; }
  ORBWEAVE_LANES static Floats Mul(Floats a, Floats b) { return a * b; }
  ORBWEAVE_LANES static Floats Div(Floats a, Floats b) { return a / b; }
  ORBWEAVE_LANES static Floats Max(Floats a, Floats b) { return a > b ? a : b; }
  ORBWEAVE_LANES static Floats Min(Floats a, Floats b) { return a < b ? a : b; }
  ORBWEAVE_LANES static Floats Abs(Floats a) {
    return reinterpret_cast<Floats>(reinterpret_cast<Ints>(a) & SetInt(0x7FFFFFFF));
  }
  ORBWEAVE_LANES static Floats Sqrt(Floats a) {
    return Floats{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
  }
  ORBWEAVE_LANES static Mask Less(Floats a, Floats b) { return a < b; }
  ORBWEAVE_LANES static Mask LessEqual(Floats a, Floats b) { return a <= b; }
  ORBWEAVE_LANES static Mask And(Mask a, Mask b) { return a & b; }
  ORBWEAVE_LANES static Mask Or(Mask a, Mask b) { return a | b; }
  ORBWEAVE_LANES static Floats Select(Mask mask, Floats yes, Floats no) { return mask ? yes : no; }
  ORBWEAVE_LANES static uint32_t Bits(Mask a) {
    const Ints bit = a & Ints{1, 2, 4, 8};
    return static_cast<uint32_t>(bit[0] | bit[1] | bit[2] | bit[3]);
  }
  ORBWEAVE_LANES static Ints Truncate(Floats a) { return __builtin_convertvector(a, Ints); }
  ORBWEAVE_LANES static Floats ToFloats(Ints a) { return __builtin_convertvector(a, Floats); }
  ORBWEAVE_LANES static Ints AddInts(Ints a, Ints b) { return a + b; }
  ORBWEAVE_LANES static Ints MulInts(Ints a, Ints b) { return a * b; }
  ORBWEAVE_LANES static Floats Gather(const float* from, Ints index) {
    return Floats{from[index[0]], from[index[1]], from[index[2]], from[index[3]]};
  }
};

void RunBlur(const BlurJob& job) { Blur<LanesPortable>(job); }
size_t RunFindExtrema(const ExtremaJob& job) { return FindExtremaOf<LanesPortable>(job); }
void RunAddOrientations(const OrientationJob& job) { AddOrientations<LanesPortable>(job); }
void RunSumDescriptor(const DescriptorJob& job) { SumDescriptor<LanesPortable>(job); }

}  // namespace

const SiftKernels& SiftKernelsPortable() {
  static constexpr SiftKernels kKernels = {
      RunBlur, RunFindExtrema, RunAddOrientations, RunSumDescriptor};
  return kKernels;
}

}  // namespace orbweave::internal
