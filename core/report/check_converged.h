// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// "adjustment_converged": what the last step of an adjustment that stopped early moved. Nothing
/// where no adjustment is known.
[[nodiscard]] std::optional<CrossCheck> CheckConverged(const JobResults& results);

}  // namespace orbweave
