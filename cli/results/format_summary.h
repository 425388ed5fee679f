// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/io/page/job_report.h"

namespace orbweave {

/// A finished job on a terminal: what was registered, how well it fits, time per stage, where the
/// outputs are.
[[nodiscard]] std::string FormatSummary(const JobReport& report, const std::string& output);

/// The verdict with its reasons, and what could not be checked: the summary's last lines.
[[nodiscard]] std::string FormatVerdict(const Verdict& verdict);

}  // namespace orbweave
