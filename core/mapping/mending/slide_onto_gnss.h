// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Slides pieces of a street along it that GNSS has elsewhere by whole houses. Where facades
/// repeat, two panoramas that take one house for the next agree with each other, with hundreds of
/// rays and with the geometry of all their pairs, as what lies along a facade is seen in the same
/// directions a house further on; rays that are right are fewer. GNSS of some metres knows a house
/// from the next: of the slides that it offers (ListSlides) and with which the squared misfits of
/// ways (GnssWays) become less by nine, three sigmas, the most promising are made, one after the
/// other. Points are made anew that images see which were moved differently, and everything is
/// adjusted.
///
/// A slide is taken if GNSS likes the result as much better, and rays contradict it in fewer places
/// than before (FindLengthFaults) or as many places hold (CountHeldPlaces): what four panoramas
/// see together all around is right, so that positions that are wrong move nothing. Eight are tried
/// at most. Whether any was taken. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> SlideOntoGnss(MappingState& state,
                                                 const MappingOptions& options,
                                                 const StageContext& context);

}  // namespace orbweave
