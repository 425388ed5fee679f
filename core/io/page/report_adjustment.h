// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// The steps of the global adjustment of the first model as an HTML table, a row per minimisation,
/// and what its blocks send. Empty without an adjustment.
[[nodiscard]] std::string AdjustmentHtml(const JobReport& report);

}  // namespace orbweave
