// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/mapping/model/mapping_state.h"

namespace orbweave {

/// Where windows or houses repeat, two panoramas that took each for the next agree on a wall behind
/// the real one, or before it. Its points fit both poses as well as right ones do, are hundreds,
/// bend the poses, and nobody else sees them: what is missing tells of them (Zach 2008).
///
/// Removes the points that two images alone see, where both is true of the pair:
/// - of what the two see, and a third image stands between them (StandsBetween) that has verified
///   pairs with one of them, it misses more than a third;
/// - they lie elsewhere than what others see beside them: as far away as a point that three images
///   see within five degrees, to a seventh, are fewer than two thirds as many of those it misses as
///   of those it sees. A third image that stands elsewhere misses much too, but leaves points in
///   their places.
///
/// On rendered streets of houses that repeat, 8 and 12 m between panoramas, 24 to 57 % are in place
/// of pairs of which the truth has fewer than four in ten points on a surface, 78 % and more of
/// others, and 97 % and more of what a third image sees. Returns the number of points removed.
uint32_t DropGhostPoints(MappingState& state);

}  // namespace orbweave
