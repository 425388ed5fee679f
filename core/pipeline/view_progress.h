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
  double fraction = 0.0;     ///< of the whole job, stages weighted by StageStatus::weight
  double tasks_per_s = 0.0;  ///< of that stage; 0: not known yet
  double eta_s = -1.0;       ///< of the whole job; negative: not known yet
};

/// The time that is left is learned from what tasks took. What remains of a stage at work is its
/// tasks that are not done, each as long as those that are, and of a loop the rounds it usually has
/// yet, each as long as those before. What stages to come will cost is their weight at the rate at
/// which the stages before cost theirs. All that is divided by the slots of the workers there are,
/// or by as many tasks as a stage has.
[[nodiscard]] ProgressView ViewProgress(const JobStatus& status);

}  // namespace orbweave
