// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// All cross checks of a job, in order, each where it applies: what pairs, rays and points of all
/// clusters say of the models (CheckPairs, CheckLengths, CheckToldSteps, CheckHinges,
/// CheckStretches, CheckStandingCamera, CheckLookAlikes); those that each model was adjusted with;
/// and what only the job as a whole knows (check_coverage.h, check_seams.h, CheckConverged,
/// CheckGnssUse). `report` has everything but its checks and verdict.
///
/// Of several models a check says which one it is of; one that holds less than one registered image
/// in twenty does not make the job bad: as many may be missing from a good one.
[[nodiscard]] std::vector<CrossCheck> CheckJob(const JobResults& results, const JobReport& report);

}  // namespace orbweave
