// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/cross_check.h"
#include "core/stages/build_job_report.h"

namespace orbweave {

/// "residual_pattern", one per model that has not made this check itself: the largest mean residual
/// that repeats at the same place of every panorama (GlobalAdjustReport::pattern_px), in pixels.
/// Such residuals bend a model without showing in its uncertainty.
[[nodiscard]] std::vector<CrossCheck> CheckResidualPatterns(const JobResults& results);

}  // namespace orbweave
