// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/merging/alignment/align_options.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/fit_seams.h"

namespace orbweave {

/// Places all submodels, whose frames and scales are their own.
///
/// Seam by seam FitSeams has found a robust relative Sim3 from common images (rotation, centre) and
/// common tracks, in units of the bearings' standard deviations, hence independent of any scale. A
/// seam is used when enough images or tracks agree on it and its information matrix is
/// well-conditioned; otherwise its report says why not.
///
/// All seams together: one robust pose graph (AverageSimilarities). A seam itself is known to
/// millimetres, the submodels between two seams bend and stretch by more: each seam's covariance is
/// its own plus drift_deg and drift_share of the submodels' extent. Loops spread their error; a
/// seam that loops contradict by more than max_contradiction such standard deviations is switched
/// off. Before that, where seams in loops share the error and are off by more than expected in the
/// median, submodels are taken for as much more bent (drift_factor), up to 16 times: both sides of
/// a seam have the same images, and a street of plain walls bends by degrees. Where most loops
/// close, one that does not makes nothing of this. Which way is up, as cameras of such submodels
/// have it (LevelOf), then counts as well: what loops leave to the bends of all would else tilt
/// whole submodels.
///
/// World 0 holds most images; submodels that no used seam joins are worlds of their own. A world
/// has the frame and scale of its submodel with most images. GNSS enters when they are joined.
/// `clusters`: in order; memory grows with images and seams, not with points. DataLoss: submodels
/// out of order. InvalidArgument: a seam of a submodel that is not there. Cancelled when asked to
/// stop.
[[nodiscard]] absl::StatusOr<Alignment> AlignSubmodels(std::span<const SeamsOfCluster> clusters,
                                                       const AlignOptions& options,
                                                       const StageContext& context);

}  // namespace orbweave
