// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/mapping/asked_rays.h"
#include "core/mapping/pair_length.h"

namespace orbweave {

/// How far rays bear out the way from each registered image of a drive to the next, as
/// MeasurePairLengths, but by what lies on one side of it. Where a street is torn, everything
/// behind the tear stands a house, or half of one, too far along: pairs that lead across are all
/// too long, bear each other out, and outnumber those beside it. Therefore a ray tells the length
/// of a pair that leads across by those of its pairs alone that stay on its own image's side, which
/// a tear leaves as they are. Pairs lead across that have no more than two images of the drive
/// between theirs: longer ones hide a step.
///
/// Of the two sides that one is returned that agrees less, if it tells enough (TellsEnough): where
/// the scale jumps, what is behind agrees with itself, and what is before does not.
///
/// Of drives in order, of images in order of their ids.
[[nodiscard]] std::vector<GapLength> MeasureGapLengths(const AskedRays& asked);

}  // namespace orbweave
