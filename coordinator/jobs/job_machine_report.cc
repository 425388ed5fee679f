// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a machine tells of its job, and of who made what.

#include <algorithm>
#include <map>

#include "coordinator/jobs/job_machine.h"

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

uint64_t JobMachine::CountOpenTasks() const {
  if (state_ != JobState::kRunning) return 0;
  const uint64_t open = runs_.empty() ? 0 : runs_.back().tasks.size() - runs_.back().done;
  return std::max<uint64_t>(open, 1);
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
      if (task.done && !task.is_repeated)
        costs.push_back({number, task.spec.stage, part, task.cost});
    }
  }
  return costs;
}

uint32_t JobMachine::LastRunOf(uint32_t stage) const {
  for (auto run = static_cast<uint32_t>(runs_.size()); run > 0; --run) {
    if (runs_[run - 1].stage == stage) return run - 1;
  }
  return static_cast<uint32_t>(runs_.size());
}

std::vector<TaskRef> JobMachine::MakersOf(const Digest& blob, TaskRef reader) const {
  const auto holds = [&blob](const std::vector<Digest>& blobs) {
    return std::ranges::find(blobs, blob) != blobs.end();
  };
  std::vector<TaskRef> makers;
  for (uint32_t stage = 0; stage < results_.size() && stage <= runs_[reader.run].stage; ++stage) {
    for (uint32_t part = 0; part < results_[stage].size(); ++part) {
      const TaskResult& result = results_[stage][part];
      if (holds(result.outputs) || holds(result.recipes))
        makers.push_back({LastRunOf(stage), part});
    }
  }
  return makers;
}

std::vector<Digest> JobMachine::TasksReadBy(TaskRef ref) const {
  const StageRule& reader = RuleOf(ref.run);
  std::set<std::string> read = {reader.parts_from};
  for (const InputRule& input : reader.inputs) read.insert(input.stage);
  std::vector<Digest> tasks;
  for (uint32_t stage = 0; stage < results_.size(); ++stage) {
    const uint32_t run = LastRunOf(stage);
    if (run == runs_.size() || !read.contains(plan_.stages[stage].stage)) continue;
    for (const TaskRecord& task : runs_[run].tasks) tasks.push_back(task.id);
  }
  return tasks;
}

}  // namespace orbweave
