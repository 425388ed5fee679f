// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/match_patches.h"

/// What the match kernels share.

namespace orbweave::internal {

/// Fixed point of positions in source faces: 16 bits of fraction, of which four choose weights.
constexpr float kFixedOne = 65536.0F;
/// Half of a sixteenth of a pixel: positions are cut to sixteenths, not rounded.
constexpr float kHalfStep = 1.0F / 32.0F;
/// No patch reaches more than five times this beyond its middle (SourceFaces::kApron_px).
constexpr float kMaxGrowth = 3.2F;
constexpr float kReach_px = 17.0F;

void MatchPortable(const ReferencePatches& patches,
                   const MatchView& view,
                   const PlaneLanes& planes,
                   float noise_variance,
                   LaneFloats& zncc);
#if defined(__x86_64__)
void MatchAvx2(const ReferencePatches& patches,
               const MatchView& view,
               const PlaneLanes& planes,
               float noise_variance,
               LaneFloats& zncc);
void MatchAvx512(const ReferencePatches& patches,
                 const MatchView& view,
                 const PlaneLanes& planes,
                 float noise_variance,
                 LaneFloats& zncc);
#endif

}  // namespace orbweave::internal
