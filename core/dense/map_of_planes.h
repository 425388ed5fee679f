// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/dense_options.h"
#include "core/dense/depth_map.h"
#include "core/dense/patch_match_round.h"
#include "core/dense/planar_prior.h"
#include "core/dense/plane_field.h"

namespace orbweave {

/// The depth map of a field of planes. A pixel may have a range of its own, where its plane
/// correlates at least `min_zncc` (from 0.3 on it may contradict the prior, no more) and its sigma
/// is at most `max_sigma` of the range, and one by the prior (of half the size), with the sigma of
/// its plane there (PlaneErrors). Where both agree within two sigmas it has their mean, weighted by
/// variances; where not, the prior's if its texture is weak, else its own, and none where that is
/// too weak. One of two that contradict each other is wrong, by what they are apart: that is the
/// sigma of the own one then, unless they are farther apart than max_sigma, as a thing and the wall
/// behind it. What the prior alone says, a weak match agreeing or not, is flagged kDepthPriorOnly.
/// Ignored pixels, and all ranges out of `limits`, have none.
[[nodiscard]] DepthMap MapOfPlanes(const ReferenceRaster& raster,
                                   const PlaneField& field,
                                   const PlanarPrior& prior,
                                   const RangeLimits& limits,
                                   const DenseOptions& options);

}  // namespace orbweave
