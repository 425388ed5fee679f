// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/model/mapping_options.h"
#include "core/mapping/model/mapping_state.h"
#include "core/mapping/model/move_images.h"

namespace orbweave {

/// What would mend the lengths that rays contradict. At each way between neighbours of a line of
/// which clearly more rays say another length (IsToldElsewhere; FindGapShift, or FindWallShift of
/// one wall), along the way and as far as they say: everything behind it; the piece from there to
/// the next such way; the image behind it alone, and the one before it alone, backwards. Where its
/// two sides say different lengths, everything behind it on the scale with which they say the same.
/// Each image at such a way or at a fault (FindLengthFaults), alone, to where the rays of those
/// around it put it (CentreByLengths). Images of other lines go with that image of the line with
/// which they have most matches.
///
/// In order of the ways, then of the images.
[[nodiscard]] std::vector<CandidateMove> ListShifts(const MappingState& state,
                                                    const MappingOptions& options);

/// What would mend ways whose two sides stand askew (IsAskew): everything behind one, with what
/// goes with it of other lines, turned and set as each of the two pairs of most matches that lead
/// across has it, at the distance that its images have. In order of the ways.
[[nodiscard]] std::vector<CandidateMove> ListTurns(const MappingState& state,
                                                   const MappingOptions& options);

}  // namespace orbweave
