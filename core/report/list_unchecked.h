// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// What no check of this job could see, for want of what a witness is made of, so that a good
/// verdict is not taken for more than it is. Pairs of panoramas tell directions and turns, and
/// along a straight street next to nothing of lengths (CheckContradictedPairs): those are told by
/// GNSS alone, and by capture times together with it (CheckDriveMotion). Also what a check found
/// that nothing tells, a late clock along a straight street (CrossCheck::is_told). Sentences for
/// people; empty: all of it was looked at, or nothing is registered.
[[nodiscard]] std::vector<std::string> ListUnchecked(const JobResults& results,
                                                     const JobReport& report);

}  // namespace orbweave
