// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/io/page/job_report.h"
#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// Time and tasks of each stage, as reports show them.
[[nodiscard]] std::vector<ReportStage> ReportStages(const JobStatus& status);

}  // namespace orbweave
