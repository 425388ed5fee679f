// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/report/job_results.h"
#include "core/scene/cross_check.h"

namespace orbweave {

/// Per image: why it cannot be placed where nine of ten of its verified pairs or more are pure
/// rotations - from one place nothing can be measured -, else empty.
[[nodiscard]] std::vector<std::string> StandingReasons(const JobResults& results);

/// "standing_camera": how many images were taken from a place of another one and are in no model.
/// nullopt: none. Images of a stop that a model holds are no reason for doubt.
[[nodiscard]] std::optional<CrossCheck> CheckStandingCamera(const JobResults& results,
                                                            std::span<const ReportImage> rows);

}  // namespace orbweave
