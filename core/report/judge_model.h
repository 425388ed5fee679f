// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/page/job_report.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// The verdict on a job: as bad as the worst of report.checks, with what those that are not good
/// say as reasons, the bad ones first and otherwise in their order; reasons that differ in numbers
/// and names alone are one, with their count. Bad without a registered image, whatever the checks
/// say. A good verdict has no reasons.
[[nodiscard]] Verdict JudgeModel(const JobReport& report);

}  // namespace orbweave
