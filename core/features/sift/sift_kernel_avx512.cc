// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/sift_kernels.h"

#if defined(__x86_64__)

#include "core/base/lanes_avx512.h"
// The lanes come first.
#include "core/features/sift/sift_lanes.h"

namespace orbweave::internal {
namespace {

__attribute__((target("avx512f,avx512bw,avx512dq"))) void RunBlur(const BlurJob& job) {
  Blur<LanesAvx512>(job);
}
__attribute__((target("avx512f,avx512bw,avx512dq"))) size_t RunFindExtrema(const ExtremaJob& job) {
  return FindExtremaOf<LanesAvx512>(job);
}
__attribute__((target("avx512f,avx512bw,avx512dq"))) void RunAddOrientations(
    const OrientationJob& job) {
  AddOrientations<LanesAvx512>(job);
}
__attribute__((target("avx512f,avx512bw,avx512dq"))) void RunSumDescriptor(
    const DescriptorJob& job) {
  SumDescriptor<LanesAvx512>(job);
}

}  // namespace

const SiftKernels& SiftKernelsAvx512() {
  static constexpr SiftKernels kKernels = {
      RunBlur, RunFindExtrema, RunAddOrientations, RunSumDescriptor};
  return kKernels;
}

}  // namespace orbweave::internal

#endif
