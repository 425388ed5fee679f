// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/sift_kernels.h"

#if defined(__x86_64__)

#include "core/base/lanes_avx2.h"
// The lanes come first.
#include "core/features/sift/sift_lanes.h"

namespace orbweave::internal {
namespace {

__attribute__((target("avx2"))) void RunBlur(const BlurJob& job) { Blur<LanesAvx2>(job); }
__attribute__((target("avx2"))) size_t RunFindExtrema(const ExtremaJob& job) {
  return FindExtremaOf<LanesAvx2>(job);
}
__attribute__((target("avx2"))) void RunAddOrientations(const OrientationJob& job) {
  AddOrientations<LanesAvx2>(job);
}
__attribute__((target("avx2"))) void RunSumDescriptor(const DescriptorJob& job) {
  SumDescriptor<LanesAvx2>(job);
}

}  // namespace

const SiftKernels& SiftKernelsAvx2() {
  static constexpr SiftKernels kKernels = {
      RunBlur, RunFindExtrema, RunAddOrientations, RunSumDescriptor};
  return kKernels;
}

}  // namespace orbweave::internal

#endif
