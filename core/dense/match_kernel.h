// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/dense/match_patches.h"

namespace orbweave {

/// Writes the zero-mean normalised cross-correlation of each lane's patch with what its plane says
/// the source shows of it, weighted bilaterally,
///
///   zncc = cov(r, s) / sqrt((var(r) + v) (var(s) + v)),   v = `noise_variance`,
///
/// so that patches of little texture correlate little. The patch's middle goes through the plane
/// exactly, its surroundings by the derivatives there; the source is read bilinearly at 1/16 px.
/// Sums are exact integers, the rest one operation at a time: the same bits from every kernel.
/// kNoMatch where the source ignores the place, sees it from behind, or more than 3.2 times as
/// large.
using MatchFunction = void (*)(const ReferencePatches& patches,
                               const MatchView& view,
                               const PlaneLanes& planes,
                               float noise_variance,
                               LaneFloats& zncc);

enum class MatchKernel { kPortable, kAvx2, kAvx512 };

/// The kernels that run on this processor, the fastest last.
[[nodiscard]] std::vector<MatchKernel> AvailableMatchKernels();
[[nodiscard]] MatchFunction MatchFunctionOf(MatchKernel kernel);

/// Patches about the pixels `middle`, middle + 2, ... of a raster with rows of `stride` pixels.
/// Fills weights and moments, not the rays.
void PreparePatches(const uint8_t* middle, int stride, ReferencePatches& patches);

}  // namespace orbweave
