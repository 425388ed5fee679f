// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// report.json: every key of JobReport but the per-image rows, in a fixed order; equal reports give
/// equal bytes.
[[nodiscard]] std::string ReportJson(const JobReport& report);

}  // namespace orbweave
