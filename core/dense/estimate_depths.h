// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/dense_options.h"
#include "core/dense/depth_map.h"
#include "core/dense/depth_problem.h"
#include "core/dense/match_kernel.h"

namespace orbweave {

/// Depths of a panorama by matching patches of it, on an equiangular cube of W / 4, with source
/// panoramas through planes (PatchMatch stereo: Bleyer, Rhemann, Rother, BMVC 2011; on chessboards
/// as Galliani et al., ICCV 2015), at a quarter, half and all of the width. At half of the width,
/// pixels that match as well at infinity are given up, and those without texture may take a plane
/// of their surroundings (FitPlanarPrior). What matches badly is left out, or flagged as of such a
/// plane alone (MapOfPlanes); what patches carry over edges is trimmed (TrimEdges); ranges have
/// sigmas (FindMinimum). A pure function of its arguments, with the same bytes from every kernel.
///
/// Degenerate problems (images that do not fit together, no source, no baseline, a pose that is no
/// number, nothing but ignored pixels) give an empty map that says why.
[[nodiscard]] DepthMap EstimateDepths(const DepthProblem& problem, const DenseOptions& options);
[[nodiscard]] DepthMap EstimateDepths(const DepthProblem& problem,
                                      const DenseOptions& options,
                                      MatchKernel kernel);

}  // namespace orbweave
