// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/features/sift/sift_kernel.h"

namespace orbweave {

std::vector<SiftKernel> AvailableSiftKernels() {
  std::vector<SiftKernel> kernels = {SiftKernel::kPortable};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) kernels.push_back(SiftKernel::kAvx2);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq")) {
    kernels.push_back(SiftKernel::kAvx512);
  }
#endif
  return kernels;
}

const internal::SiftKernels& SiftKernelsOf([[maybe_unused]] SiftKernel kernel) {
#if defined(__x86_64__)
  if (kernel == SiftKernel::kAvx2) return internal::SiftKernelsAvx2();
  if (kernel == SiftKernel::kAvx512) return internal::SiftKernelsAvx512();
#endif
  return internal::SiftKernelsPortable();
}

}  // namespace orbweave
