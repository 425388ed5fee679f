// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/dense/dense_options.h"
#include "core/dense/depth_map.h"
#include "core/dense/patch_match_round.h"
#include "core/dense/planar_prior.h"
#include "core/dense/plane_field.h"

namespace orbweave {

/// The depth map of a field of planes. A pixel whose plane correlates at least `min_zncc` and whose
/// sigma is at most `max_sigma` of its range has that plane's range; another that the prior (of
/// half the size) puts on a plane has that one's, is flagged kDepthPriorOnly, and has three times
/// the plane's scatter as sigma. Ignored pixels, and all ranges out of `limits`, have none.
[[nodiscard]] DepthMap MapOfPlanes(const ReferenceRaster& raster,
                                   const PlaneField& field,
                                   const PlanarPrior& prior,
                                   const RangeLimits& limits,
                                   const DenseOptions& options);

}  // namespace orbweave
