// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/scene/ids.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// A set of features that matches join, sorted; at most one per image where `consistent`.
struct FeatureTrack {
  std::vector<FeatureRef> features{};
};

struct BuiltTracks {
  std::vector<FeatureTrack> tracks{};  ///< sorted by first feature, two features at least
  uint32_t num_conflicting = 0;  ///< joins refused because they held two features of one image
};

/// Tracks by union-find over verified matches, strongest pairs first; a join that would put two
/// features of one image into a track is refused.
[[nodiscard]] BuiltTracks BuildTracks(std::span<const TwoViewGeometry> pairs);

}  // namespace orbweave
