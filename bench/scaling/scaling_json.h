// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "bench/scaling/scaling_report.h"

namespace orbweave {

/// The whole report as JSON, every number of it.
[[nodiscard]] std::string ScalingJson(const ScalingReport& report);

}  // namespace orbweave
