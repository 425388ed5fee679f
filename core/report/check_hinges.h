// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "hinges": whether panoramas hang at the rest of their model by fewer points that three of them
/// see than tell how large what hangs there is (HingeFinder). How large such a piece is, and where
/// it stands, is what a handful of points make of it; a few wrong ones agree with each other often
/// enough, and no residual tells. In models of eighteen streets that came out right, rendered ones
/// of panoramas up to 12 m apart among them, 25 points held a panorama and 56 a piece of two or
/// more at least; in walks through rooms and wards 3 to 11 held what nobody knows to be right.
///
/// A piece that GNSS puts where the model has it is not asked: seven tenths of its positions agree,
/// and the way from the nearest panorama of the rest to the farthest of it is known to two fifths.
/// Value: the fewest points, of pieces that are asked; the limit where there are none.
[[nodiscard]] CrossCheck CheckHinges(const JobResults& results);

}  // namespace orbweave
