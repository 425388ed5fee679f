// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/patch_match_round.h"
#include "core/dense/planar_prior.h"
#include "core/dense/plane_field.h"

namespace orbweave {

/// Cost of a pixel's plane: 1 - zncc (0 ... 1) of its block's sources, the best counting most.
/// Gives each pixel the cheapest of the plane it holds and of those that the round tries; red
/// pixels of the chessboard from black neighbours, then black ones from red (Galliani et al., ICCV
/// 2015, with the regions of Xu and Tao, CVPR 2019). Random numbers are a function of seed, pixel
/// and iteration. Refining sets the sigmas (FindMinimum).
void RunRound(const PatchMatchContext& context, const PatchMatchRound& round, PlaneField& field);

/// Takes their planes (cost 2, no sigma) from pixels that match at infinity as well as with what
/// they hold. A neighbour's plane may win them back.
void DropSky(const PatchMatchContext& context, PlaneField& field);

/// Gives pixels the plane that the prior has for them where it costs less than what they hold, or,
/// the less texture they have, not much more; those of weak texture hold none then and leave it to
/// the prior.
void TryPrior(const PatchMatchContext& context, const PlanarPrior& prior, PlaneField& field);

}  // namespace orbweave
