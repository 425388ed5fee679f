// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/match_kernels.h"

#if defined(__x86_64__)

#include "core/base/lanes_avx512.h"
// The lanes come first.
#include "core/dense/match_lanes.h"

namespace orbweave::internal {

__attribute__((target("avx512f,avx512bw,avx512dq"))) void MatchAvx512(
    const ReferencePatches& patches,
    const MatchView& view,
    const PlaneLanes& planes,
    float noise_variance,
    LaneFloats& zncc) {
  MatchLanes<LanesAvx512>(patches, view, planes, noise_variance, zncc);
}

}  // namespace orbweave::internal

#endif
