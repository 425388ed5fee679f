// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/scene/places_in_drives.h"

namespace orbweave {

/// Whether the images are neighbours in the sequence of one drive, five captures apart at most, and
/// it was not left off between them: their pair is hardly ever one of places that only look alike.
[[nodiscard]] inline bool IsInSequence(const ImagePair& pair, const PlacesInDrives& places) {
  constexpr uint32_t kMostCaptures = 5;
  return places.AreOfOneStretch(pair) && places.CapturesBetween(pair) <= kMostCaptures;
}

}  // namespace orbweave
