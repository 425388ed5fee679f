// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/scaling/scaling_report.h"

namespace orbweave {

/// The stages of the largest job as a section of HTML.
[[nodiscard]] std::string ScalingStagesHtml(const ScalingReport& report);
/// The jobs that were run, or nothing.
[[nodiscard]] std::string ScalingRunsHtml(const ScalingReport& report);

}  // namespace orbweave
