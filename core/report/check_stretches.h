// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "stretch_lengths": whether stretches whose positions contradict the model are as long in it as
/// these have them. A receiver that is off by some street says wrong where a stretch is, and hardly
/// how long it is; where its positions go on as evenly as before, but the model has the stretch
/// half as long again or less than two thirds, it is the model that may have it of another scale: a
/// street that hardly a point holds to the rest, whose positions, all together, count as outliers.
///
/// Asked are runs of four contradicted panoramas or more in a row (GnssDrivesOf), by the distance
/// of the first from the last: it has to differ by three standard deviations of the stated
/// positions, and by the factor; and GNSS has to go as straight as the model within a third, which
/// positions that are each off in their own way do not. Of ten and more the scale with which they
/// fit their positions best (FitPlanRobustly) has to differ by a twentieth only, and by four
/// deviations (CarryOnByGnss): forty that stood 6 m apart instead of 5 were up to 24 m off. Of a
/// town's side street of seven panoramas that stood 2.8 m apart instead of 11 nothing else spoke.
/// Value: the worst factor, 1 or more.
[[nodiscard]] CrossCheck CheckStretches(const JobResults& results);

}  // namespace orbweave
