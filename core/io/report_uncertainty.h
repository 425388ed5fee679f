// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/job_report.h"

namespace orbweave {

/// What sigmas are relative to, as a sentence.
[[nodiscard]] std::string UncertaintyFrameText(const ReportUncertainty& uncertainty);

/// Typical and worst sigmas of the main model as an HTML table, and what they rest on.
[[nodiscard]] std::string UncertaintyHtml(const JobReport& report);

}  // namespace orbweave
