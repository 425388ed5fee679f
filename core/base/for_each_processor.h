// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// A function compiled for several instruction sets, of which the loader takes the best that the
/// processor has. For integers, and for floats where no sum runs across lanes: the results are the
/// same, since the build contracts no products and sums.
#if defined(__x86_64__)
#define ORBWEAVE_FOR_EACH_PROCESSOR \
  __attribute__((target_clones("arch=skylake-avx512", "avx2", "default")))
#else
#define ORBWEAVE_FOR_EACH_PROCESSOR
#endif
