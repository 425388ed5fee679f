// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// Says what was not matched as it goes along with the camera, where a hundredth and more of what
/// cameras see around them shows it, and lists masks to begin with: of drives without any.
void TellCarriers(const JobResults& results, JobReport& report);

}  // namespace orbweave
