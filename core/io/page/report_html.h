// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// report.html: one self-contained page (inline CSS and SVG, nothing fetched, light and dark):
/// headline numbers, map of the trajectory, residuals, tracks per image, seams, time per stage,
/// what was left out and why.
[[nodiscard]] std::string ReportHtml(const JobReport& report);

}  // namespace orbweave
