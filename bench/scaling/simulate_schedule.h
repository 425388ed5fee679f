// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pipeline/stage_needs.h"
#include "core/pipeline/task.h"
#include "core/pipeline/worker_offers.h"

namespace orbweave {

/// What one task asks of a worker.
struct PartLoad {
  double compute_s = 0.0;
  double bytes = 0.0;  ///< read and written
};

/// One run of a stage: no task of it starts before the run before is done.
struct StageLoad {
  std::string stage{};
  std::vector<PartLoad> parts{};
  StageNeeds needs{};  ///< of each part
};

/// The runs of a job from its measured tasks, in (run, part) order. A task computes for as long as
/// its CPU time: a worker has one thread, and waiting for processors that others keep busy is no
/// property of the task. What was measured does not tell what tasks need.
[[nodiscard]] std::vector<StageLoad> StageLoadsOf(const std::vector<MeasuredTask>& tasks);

/// What is assumed of the machines.
struct FleetModel {
  double worker_gbit_per_s = 1.0;        ///< between a worker and the blobs
  double coordinator_gbit_per_s = 10.0;  ///< shared by all workers
  double task_overhead_s = 0.0;          ///< a worker's time per task beside it: lease, hand-in
  double stage_overhead_s = 0.0;         ///< from the end of a run to the start of the next
  double coordinator_s_per_task = 0.0;   ///< of the coordinator's own time, one task after another
  uint32_t slots = 1;                    ///< of each worker
  double processors_per_slot = 1.0;      ///< a slot with less takes so much longer to compute
  WorkerOffers offers{};                 ///< of each worker
};

struct Schedule {
  double makespan_s = 0.0;
  std::vector<double> run_s{};  ///< by run; they sum up to the makespan
};

/// List scheduling of the runs, one after the other, on `workers` equal workers: the next part in
/// order goes to the worker that has room for it first, for
///
///   task_overhead_s + compute_s / processors_per_slot + 8 bytes n / worker_gbit_per_s,
///
/// where n tasks of that run have room on a worker at a time (TasksAtOnce) and share its link. A
/// run that has room nowhere never ends.
///
/// A run takes no less than its bytes need on the coordinator's link and its tasks in the
/// coordinator's time. More workers are never slower; the makespan is never below the sum of all
/// tasks over `workers`. CHECK: at least one worker.
[[nodiscard]] Schedule SimulateSchedule(const std::vector<StageLoad>& runs,
                                        uint32_t workers,
                                        const FleetModel& model);

/// The same with a worker for every task and an endless coordinator: the longest task of each run.
[[nodiscard]] Schedule CriticalPath(const std::vector<StageLoad>& runs, const FleetModel& model);

}  // namespace orbweave
