// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "core/scene/places_in_drives.h"

namespace orbweave {

/// Whether the images are neighbours in the sequence of one drive, five places apart at most: their
/// pair is hardly ever one of places that only look alike.
[[nodiscard]] inline bool IsInSequence(const ImagePair& pair, const PlacesInDrives& places) {
  constexpr uint32_t kSequenceSteps = 5;
  const std::optional<uint32_t> steps = places.StepsBetween(pair);
  return steps && *steps <= kSequenceSteps;
}

}  // namespace orbweave
