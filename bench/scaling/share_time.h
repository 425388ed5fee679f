// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/pipeline/job_api.h"

namespace orbweave {

/// What the slots of a fleet did from the submission of a job to its end, in seconds of slots.
struct TimeShares {
  double computing_s = 0.0;  ///< processor time of tasks, as long as a slot's share takes for it
  double waiting_s = 0.0;    ///< of tasks beside it: for blobs, or for a processor
  double leasing_s = 0.0;    ///< to be given a task while there were some, and to hand it in
  double barrier_s = 0.0;    ///< while others did the last tasks of a stage
  double serial_s = 0.0;     ///< while another did the one task of a stage
  double planning_s = 0.0;   ///< between stages, and before the first and after the last
  double repeated_s = 0.0;   ///< on attempts that came to nothing

  [[nodiscard]] double Sum() const {
    return computing_s + waiting_s + leasing_s + barrier_s + serial_s + planning_s + repeated_s;
  }
};

/// Divides the time of `slots` slots over `wall_s` seconds by what they did, from the attempts at
/// a job's tasks and what the tasks took. `processors_per_slot` as in JobMeasurement. The sum is
/// slots x wall_s, unless attempts overlap in a slot or reach beyond the end.
[[nodiscard]] TimeShares ShareTime(const std::vector<TaskTiming>& timings,
                                   const std::vector<MeasuredTask>& tasks,
                                   uint32_t slots,
                                   double processors_per_slot,
                                   double wall_s);

}  // namespace orbweave
