// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coordinator/jobs/job_machine.h"

namespace orbweave::testing {

/// One stage after the other, without inputs.
inline JobPlan LinePlan(const std::vector<std::string>& stages) {
  JobPlan plan{.kind = "line"};
  for (const std::string& stage : stages) plan.stages.push_back({.stage = stage, .version = "1"});
  return plan;
}

inline JobMachine MachineFor(const std::vector<std::string>& stages) {
  return {{.kind = "line", .label = "test"},
          LinePlan(stages),
          {.max_transient = 3, .max_infrastructure = 4, .max_process_lost = 2, .first_wait_s = 1.0},
          100.0};
}

/// `count` tasks of a stage, told apart by their input; those of another round are others.
inline std::vector<TaskSpec> Tasks(const std::string& stage, uint32_t count, uint32_t round = 0) {
  std::vector<TaskSpec> tasks;
  for (uint32_t part = 0; part < count; ++part) {
    tasks.push_back({.stage = stage,
                     .inputs = {DigestOf(std::to_string(part)), DigestOf(std::to_string(round))},
                     .part = part});
  }
  return tasks;
}

inline void Begin(JobMachine& machine,
                  const std::string& stage,
                  uint32_t count,
                  double now_s = 100.0,
                  uint32_t round = 0) {
  machine.StageBegins(
      Tasks(stage, count, round), std::vector<std::optional<TaskResult>>(count), now_s);
}

/// Leases what comes next to `worker`.
inline AttemptRef LeaseNext(JobMachine& machine,
                            const std::string& worker,
                            double now_s,
                            uint64_t epoch = 1) {
  const std::optional<TaskRef> ref = machine.NextReady({worker}, {worker}, now_s);
  ORBWEAVE_CHECK(ref.has_value());
  machine.TaskLeased(*ref, {.epoch = epoch, .worker = worker}, now_s);
  return {*ref, epoch};
}

}  // namespace orbweave::testing
