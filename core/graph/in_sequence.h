// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/scene/places_in_drives.h"

namespace orbweave {

/// Whether the images are neighbours in the sequence of one drive, five captures apart at most,
/// with those that are missing (CapturesAlong): their pair is hardly ever one of places that only
/// look alike. Positions have no say: where they jump, the drive goes on.
[[nodiscard]] inline bool IsInSequence(const ImagePair& pair, const PlacesInDrives& places) {
  constexpr uint32_t kMostCaptures = 5;
  const std::optional<uint32_t> captures = places.CapturesBetween(pair);
  return captures && *captures <= kMostCaptures;
}

}  // namespace orbweave
