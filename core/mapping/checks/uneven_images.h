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

/// Two registered images one after the other in an even drive, from one to the other of which
/// hardly a way leads, or one back.
struct VanishedWay {
  ImageSlot image = 0;
  ImageSlot next = 0;
  double step = 0.0;   ///< as steps are around
  double share = 0.0;  ///< of it; negative: it leads back
};

/// Steps of a model that have vanished (FindVanishedSteps), as far as positions do not bear them
/// out (IsDoubted). In order of drives, along each.
[[nodiscard]] std::vector<VanishedWay> FindVanishedWays(const MappingState& state);

}  // namespace orbweave
