// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// Time that is in no task.
struct ScheduleOverhead {
  double task_s = 0.0;   ///< of a worker per task: lease, hand-in
  double stage_s = 0.0;  ///< between the last task of a run and the first of the next
};

/// Medians over the finished attempts of one job, computed without a break:
///
///   task_s   the time a worker held a task beyond computing it, and the wait for its next in the
///            same run
///   stage_s  the time from the end of a run to the first lease of the next
///
/// Zero where there is nothing to measure.
[[nodiscard]] ScheduleOverhead MeasureOverhead(const std::vector<TaskTiming>& timings,
                                               const std::vector<MeasuredTask>& tasks);

}  // namespace orbweave
