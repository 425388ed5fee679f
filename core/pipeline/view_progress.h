// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// A job's progress in figures.
struct ProgressView {
  std::string stage{};      ///< the stage at work; empty when all are done
  double tasks_done = 0.0;  ///< of that stage, running tasks counted by what they report
  uint32_t tasks_total = 0;
  double fraction = 0.0;     ///< of the whole job, stages weighted by what they usually cost
  double tasks_per_s = 0.0;  ///< of that stage; 0: not known yet
  double eta_s = -1.0;       ///< of the whole job; negative: not known yet
};

[[nodiscard]] ProgressView ViewProgress(const JobStatus& status);

}  // namespace orbweave
