// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// What sigmas are relative to, as a sentence.
[[nodiscard]] std::string UncertaintyFrameText(const ReportUncertainty& uncertainty);

/// The median position sigma of the main model as a share of its path and of the step between
/// neighbours: "31 ppm of a path of 1,250 m, 0.52 % of a step of 7.4 m"; where the order of the
/// images is not known, "0.23 % of the distance to the nearest panorama, 9 m". What is left of it
/// where units mean nothing. Empty where unknown.
[[nodiscard]] std::string RelativePrecisionText(const JobReport& report);

/// Typical and worst sigmas of the main model as an HTML table, and what they rest on.
[[nodiscard]] std::string UncertaintyHtml(const JobReport& report);

}  // namespace orbweave
