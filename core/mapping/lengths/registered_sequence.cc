// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/lengths/registered_sequence.h"

#include "core/mapping/lengths/street_lines.h"

namespace orbweave {

RegisteredSequence::RegisteredSequence(const MappingState& state, double tolerance_px)
    : place_(state.Graph().NumImages()), line_(place_.size()) {
  uint32_t number = 0;
  for (const StreetLine& line : FindStreetLines(state, tolerance_px)) {
    for (const ImageSlot image : line) {
      place_[image] = images_.size();
      line_[image] = number;
      images_.push_back(image);
    }
    ++number;
  }
}

}  // namespace orbweave
