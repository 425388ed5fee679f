// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// What is thought of the model, and why: the first thing on the page.
[[nodiscard]] std::string VerdictHtml(const JobReport& report);

/// All cross checks as a table, those that are not good first. Empty without checks.
[[nodiscard]] std::string ChecksHtml(const JobReport& report);

}  // namespace orbweave
