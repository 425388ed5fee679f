// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/io/page/job_report.h"
#include "core/report/job_results.h"

namespace orbweave {

/// "images_registered": share of the job's images that a model observes.
[[nodiscard]] CrossCheck CheckRegistered(const JobReport& report);

// The others say nothing where no image is registered.

/// "images_in_one_frame": share of the registered images that lie in the largest frame: all
/// georeferenced models share one, every other model has its own.
[[nodiscard]] std::optional<CrossCheck> CheckFrames(const JobReport& report);

/// "connected_in_one_model": share of the registered images that are in the model that holds most
/// of their part, over all parts that verified pairs hold together.
[[nodiscard]] std::optional<CrossCheck> CheckConnected(const JobResults& results,
                                                       const JobReport& report);

/// "uncertainty_known": share of the registered images whose sigmas are known.
[[nodiscard]] std::optional<CrossCheck> CheckUncertainty(const JobReport& report);

}  // namespace orbweave
