// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// One word for people and style sheets: good, doubtful, bad, unknown.
[[nodiscard]] std::string VerdictText(SeamVerdict verdict);

/// The certificate of every seam as an HTML table: what joins its sides, and their jump before and
/// after the global adjustment. Empty without seams.
[[nodiscard]] std::string SeamsHtml(const JobReport& report);

}  // namespace orbweave
