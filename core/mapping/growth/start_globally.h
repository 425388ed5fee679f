// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/base/stage_context.h"
#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// A model of all images at once instead of a seed: poses by PlaceByPairs, points from all their
/// matches under loose limits, one robust adjustment, then points anew under the usual limits, as
/// loose ones hold wrong rays that the adjustment bent them to. Where GNSS places it, the model is
/// in east, north and up, and held to its positions as long as it grows. Images that then do not
/// agree with as many of the points they should see as registration asks for are left to it.
/// `state` must be empty. False, with the state as it may be: fewer than
/// options.min_component_images images stay. GrowSubmodel goes on from here. Cancelled when asked
/// to stop.
[[nodiscard]] absl::StatusOr<bool> StartGlobally(MappingState& state,
                                                 std::span<const uint8_t> available,
                                                 const MappingOptions& options,
                                                 const StageContext& context);

/// The same from poses by PlaceByPositions.
[[nodiscard]] absl::StatusOr<bool> StartOnPositions(MappingState& state,
                                                    std::span<const uint8_t> available,
                                                    const MappingOptions& options,
                                                    const StageContext& context);

}  // namespace orbweave
