// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/mapping/lengths/pair_length.h"
#include "core/mapping/lengths/registered_sequence.h"
#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// The way from a registered image of a line to the next, and the pairs that lead across it: those
/// that have no more than two images of the line between theirs, as longer ones hide a step.
struct WayAlongLine {
  ImageSlot image = 0;
  ImageSlot next = 0;
  std::vector<uint32_t> pairs{};  ///< of the graph's; may be none
};

/// All of them, of lines in order, of images along them.
[[nodiscard]] std::vector<WayAlongLine> WaysAlongLines(const MappingState& state,
                                                       const RegisteredSequence& places);

/// Matches of the pairs that lead across, and those that agree (GapLength::matches).
[[nodiscard]] LengthAgreement MatchesAcross(const MappingState& state,
                                            const WayAlongLine& way,
                                            double tolerance_px);

}  // namespace orbweave
