// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "bench/scaling/simulate_schedule.h"

namespace orbweave {

/// Exponents of a stage's growth over the number of panoramas.
struct StageGrowth {
  double compute = 1.0;
  double bytes = 1.0;
};

/// A guess at the same kind of job `factor` times as large: runs of one task keep one; those of
/// several get `factor` times as many, by repeating the measured ones in turn; and the tasks of
/// every run are scaled so that their time and bytes grow together by factor^compute and
/// factor^bytes. Loops run as often as they did. A stage that `growth` does not name grows
/// linearly.
[[nodiscard]] std::vector<StageLoad> GrowJob(const std::vector<StageLoad>& runs,
                                             double factor,
                                             const std::map<std::string, StageGrowth>& growth);

}  // namespace orbweave
