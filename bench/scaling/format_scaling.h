// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/scaling/scaling_report.h"

namespace orbweave {

/// The tables of a scaling report in Markdown: runs, stages, and what is simulated.
[[nodiscard]] std::string FormatScaling(const ScalingReport& report);

}  // namespace orbweave
