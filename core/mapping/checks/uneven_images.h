// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_state.h"
#include "core/scene/uneven_stops.h"

namespace orbweave {

/// Registered images of a drive, one after the other, of which one stands too far along the way, or
/// not far enough.
struct UnevenRun {
  std::vector<ImageSlot> images{};
  UnevenStop uneven{};  ///< places in `images`
};

/// Where images of a model stand off the even steps of their drives (FindUnevenStops) and are not
/// borne out there by positions. In order of drives, along each.
[[nodiscard]] std::vector<UnevenRun> FindUnevenRuns(const MappingState& state);

}  // namespace orbweave
