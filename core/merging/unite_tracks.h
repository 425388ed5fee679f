// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/scene/reconstruction.h"

namespace orbweave {

struct UnitedTracks {
  std::vector<Track> tracks{};   ///< sorted by name, two observations at least
  uint32_t num_united = 0;       ///< tracks made of two or more
  uint32_t num_conflicting = 0;  ///< joins refused
};

/// Unites tracks of several submodels, all in one world, that hold a feature in common; those with
/// most common features first. A join is refused when the united track would hold two features of
/// one image, or when the point of either, seen by the cameras of the other, is off by more than
/// max(`max_error`, three times the median of all joins), root mean square in standard deviations
/// of a bearing. The point of a united track is the mean weighted by observations, the colour that
/// of the longest part. A feature that refused joins leave in two tracks goes to the longer one.
/// Observations of images not in `images` are dropped, tracks with fewer than two observations too.
[[nodiscard]] UnitedTracks UniteTracks(std::span<const Track> tracks,
                                       const std::map<ImageId, RegisteredImage>& images,
                                       double max_error);

}  // namespace orbweave
