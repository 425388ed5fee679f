// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a machine tells of its job.

#include <map>

#include "coordinator/job_machine.h"

namespace orbweave {

JobStatus JobMachine::Status(double now_s) const {
  JobStatus status{.id = spec_.Id(), .state = state_, .error = error_, .spec = spec_};
  status.elapsed_s = (state_ == JobState::kRunning ? now_s : ended_s_) - submitted_s_;
  for (const StageRule& rule : plan_.stages) {
    status.stages.push_back({.stage = rule.stage,
                             .weight = rule.weight,
                             .usual_runs = rule.usual_runs,
                             .has_parts = !rule.HasOnePart()});
  }
  for (const StageRun& run : runs_) run.AddTo(status.stages[run.stage]);
  return status;
}

std::vector<TaskOutcome> JobMachine::Outcomes() const {
  std::map<uint32_t, const StageRun*> last_runs;
  for (const StageRun& run : runs_) last_runs[run.stage] = &run;
  std::vector<TaskOutcome> outcomes;
  for (const auto& [stage, run] : last_runs) {
    for (uint32_t part = 0; part < run->tasks.size(); ++part) {
      const TaskRecord& task = run->tasks[part];
      if (task.done) outcomes.push_back({task.spec.stage, part, task.id, results_[stage][part]});
    }
  }
  return outcomes;
}

std::vector<MeasuredTask> JobMachine::Costs() const {
  std::vector<MeasuredTask> costs;
  for (uint32_t number = 0; number < runs_.size(); ++number) {
    for (uint32_t part = 0; part < runs_[number].tasks.size(); ++part) {
      const TaskRecord& task = runs_[number].tasks[part];
      if (task.done) costs.push_back({number, task.spec.stage, part, task.cost});
    }
  }
  return costs;
}

}  // namespace orbweave
