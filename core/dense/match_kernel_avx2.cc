// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/dense/match_kernels.h"

#if defined(__x86_64__)

#include "core/base/lanes_avx2.h"
// The lanes come first.
#include "core/dense/match_lanes.h"

namespace orbweave::internal {

__attribute__((target("avx2"))) void MatchAvx2(const ReferencePatches& patches,
                                               const MatchView& view,
                                               const PlaneLanes& planes,
                                               float noise_variance,
                                               LaneFloats& zncc) {
  MatchLanes<LanesAvx2>(patches, view, planes, noise_variance, zncc);
}

}  // namespace orbweave::internal

#endif
