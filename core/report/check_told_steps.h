// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "told_steps": whether anything says how long steps between panoramas are. Two panoramas alone
/// say which way one lies from the other; how far, only what a third one sees as well: of all rays
/// of the pairs that lead across a step, those that pairs beside it share, and those that tie its
/// two ends to neighbours off the line, where a camera was carried about a room
/// (GapLength::telling_rays). Far apart, twelve metres in a street, hardly any are left, and
/// lengths are what noise and houses that look alike make of them. Asked are steps across which 100
/// rays lead; where fewer than 25 tell, and GNSS does not bear the length out
/// (GapLength::is_borne_out), the check is doubtful. In rendered streets of panoramas 8 m apart
/// that came out right to centimetres 76 told at least; 12 m apart, of steps that were wrong by
/// metres, 10 to 25 in many.
///
/// Within models; a step of two clusters by the one that tells more. Value: the fewest, of steps
/// that GNSS does not bear out; the limit where there are none.
[[nodiscard]] CrossCheck CheckToldSteps(const JobResults& results);

}  // namespace orbweave
