// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Puts what lies behind a way of a street on the scale, and to the place along the way, that GNSS
/// has it at. Where all pairs across a way take one window for the next, all behind it may be a
/// fifth too long, step by step, or a house too far on: no step is off by more than positions of
/// some metres are, and all of them together by tens of metres.
///
/// Of the thirty images with positions on either side of a way, at least ten, in one line
/// (FindPlacedImages), a similarity of the one side and one of the other (FitPlanRobustly) say how
/// many metres a unit is before and behind it, and how far apart along the way they have its end.
/// Where either is four deviations off, and scales by a twentieth, everything behind (LinePieces)
/// is scaled about that end and shifted, the ways that are off the most first, six of them at most;
/// points between are made anew and all is adjusted. Taken is what GNSS then likes better
/// (IsLikedByGnss), if it stays, and points allow it: rays contradict the model in fewer places
/// (FindLengthFaults), or in no more and as many places hold (CountHeldPlaces). A clock that is
/// late looks the same along a way, but tears what points hold. Deviations are those that errors of
/// positions show (ScatterOfPositions), three times, as neighbours share them.
///
/// Whether anything was taken. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<bool> CarryOnByGnss(MappingState& state,
                                                 const MappingOptions& options,
                                                 const StageContext& context);

}  // namespace orbweave
