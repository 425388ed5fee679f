// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/scaling/scaling_report.h"

namespace orbweave {

/// The report as one page with nothing outside it: time and efficiency over workers, where the time
/// goes, stages, runs. What is simulated or extrapolated is marked as such.
[[nodiscard]] std::string ScalingHtml(const ScalingReport& report);

}  // namespace orbweave
