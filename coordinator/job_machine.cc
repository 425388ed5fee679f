// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_machine.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

std::string DescribeTask(const TaskSpec& spec, const Digest& id) {
  return absl::StrCat("stage ", spec.stage, ", part ", spec.part, " (task ", id.ToShortHex(), ")");
}

std::string TextOf(const absl::Status& status) {
  return absl::StrCat(absl::StatusCodeToString(status.code()), ": ", status.message());
}

double FractionOf(const Progress& progress) {
  if (progress.total == 0) return 0.0;
  return std::min(1.0, static_cast<double>(progress.done) / static_cast<double>(progress.total));
}

}  // namespace

JobMachine::JobMachine(JobSpec spec, JobPlan plan, RetryPolicy policy, double now_s)
    : spec_(std::move(spec)), plan_(std::move(plan)), policy_(policy), submitted_s_(now_s) {}

std::optional<uint32_t> JobMachine::StageToPlan() const {
  if (state_ != JobState::kRunning || stages_.size() == plan_.stages.size()) return std::nullopt;
  if (!stages_.empty() && stages_.back().done < stages_.back().tasks.size()) return std::nullopt;
  return static_cast<uint32_t>(stages_.size());
}

bool JobMachine::MayTake(const TaskRecord& task,
                         const std::string& worker,
                         const std::vector<std::string>& alive,
                         double now_s) const {
  const auto failed_on = [&task](const std::string& name) {
    return std::find(task.failed_on.begin(), task.failed_on.end(), name) != task.failed_on.end();
  };
  if (task.not_before_s > now_s) return false;
  return !failed_on(worker) || std::all_of(alive.begin(), alive.end(), failed_on);
}

std::optional<TaskRef> JobMachine::NextReady(const std::string& worker,
                                             const std::vector<std::string>& alive,
                                             double now_s) const {
  if (state_ != JobState::kRunning || stages_.empty()) return std::nullopt;
  const StageRecord& stage = stages_.back();
  for (const uint32_t part : stage.ready) {
    if (!MayTake(stage.tasks[part], worker, alive, now_s)) continue;
    return TaskRef{static_cast<uint32_t>(stages_.size() - 1), part};
  }
  return std::nullopt;
}

bool JobMachine::WasDoneBy(const Digest& task, uint64_t epoch) const {
  const auto it = refs_.find(task);
  return it != refs_.end() && Task(it->second).done && Task(it->second).holder.epoch == epoch;
}

void JobMachine::StageBegins(std::vector<TaskSpec> tasks,
                             std::vector<std::optional<TaskResult>> found,
                             double now_s) {
  ORBWEAVE_CHECK(StageToPlan().has_value() && tasks.size() == found.size());
  const auto number = static_cast<uint32_t>(stages_.size());
  StageRecord& stage = stages_.emplace_back();
  results_.emplace_back(tasks.size());
  for (uint32_t part = 0; part < tasks.size(); ++part) {
    TaskRecord& task = stage.tasks.emplace_back();
    task.id = tasks[part].Id();
    task.spec = std::move(tasks[part]);
    refs_[task.id] = {number, part};
    if (!found[part]) {
      stage.ready.insert(part);
      continue;
    }
    task.done = true;
    results_.back()[part] = *std::move(found[part]);
    ++stage.done;
    ++stage.reused;
  }
  EndIfAllDone(now_s);
}

void JobMachine::TaskLeased(TaskRef ref, const TaskHolder& holder, double now_s) {
  StageRecord& stage = stages_[ref.stage];
  ORBWEAVE_CHECK(stage.ready.erase(ref.part) == 1);
  stage.running.insert(ref.part);
  if (!stage.first_lease_s) stage.first_lease_s = now_s;
  TaskRecord& task = Task(ref);
  task.holder = holder;
  task.leased_s = now_s;
  task.progress = {};
}

void JobMachine::TaskProgressed(TaskRef ref, const Progress& progress) {
  Task(ref).progress = progress;
}

void JobMachine::AttemptEnds(TaskRef ref, bool ok, double now_s) {
  const TaskRecord& task = Task(ref);
  ORBWEAVE_CHECK(stages_[ref.stage].running.erase(ref.part) == 1);
  timings_.push_back({.stage = task.spec.stage,
                      .part = ref.part,
                      .worker = task.holder.worker,
                      .slot = task.holder.slot,
                      .start_s = task.leased_s - submitted_s_,
                      .end_s = now_s - submitted_s_,
                      .ok = ok});
}

void JobMachine::TaskDone(TaskRef ref, TaskResult result, double now_s) {
  if (state_ != JobState::kRunning) return;
  AttemptEnds(ref, true, now_s);
  StageRecord& stage = stages_[ref.stage];
  Task(ref).done = true;
  ++stage.done;
  stage.last_result_s = now_s;
  stage.cpu_s += result.cpu_s;
  results_[ref.stage][ref.part] = std::move(result);
  EndIfAllDone(now_s);
}

void JobMachine::TaskFailed(TaskRef ref, const absl::Status& error, double now_s) {
  if (state_ != JobState::kRunning) return;
  AttemptEnds(ref, false, now_s);
  StageRecord& stage = stages_[ref.stage];
  stage.ready.insert(ref.part);
  const FailureClass failure = ClassifyFailure(error.code());
  if (failure == FailureClass::kReturned) return;
  TaskRecord& task = Task(ref);
  ++task.failures;
  if (failure == FailureClass::kPermanent) {
    JobFails(absl::StrCat(DescribeTask(task.spec, task.id), ": ", TextOf(error)), now_s);
  } else if (task.failures >= policy_.max_attempts) {
    JobFails(absl::StrCat(DescribeTask(task.spec, task.id),
                          " failed ",
                          task.failures,
                          " times, last on ",
                          task.holder.worker,
                          ": ",
                          TextOf(error)),
             now_s);
  } else {
    ++stage.retries;
    task.failed_on.push_back(task.holder.worker);
    task.not_before_s = now_s + policy_.WaitAfter(task.failures);
  }
}

void JobMachine::JobFails(const std::string& error, double now_s) {
  error_ = error;
  JobEnds(JobState::kFailed, now_s);
}

void JobMachine::JobIsCancelled(double now_s) {
  if (state_ == JobState::kRunning) JobEnds(JobState::kCancelled, now_s);
}

void JobMachine::EndIfAllDone(double now_s) {
  const bool all_planned = stages_.size() == plan_.stages.size();
  if (all_planned && stages_.back().done == stages_.back().tasks.size())
    JobEnds(JobState::kDone, now_s);
}

void JobMachine::JobEnds(JobState state, double now_s) {
  state_ = state;
  ended_s_ = now_s;
  for (StageRecord& stage : stages_) stage.running.clear();
}

StageStatus JobMachine::StatusOfStage(uint32_t number) const {
  StageStatus status{.stage = plan_.stages[number].stage};
  if (number >= stages_.size()) return status;
  const StageRecord& stage = stages_[number];
  status.tasks_total = static_cast<uint32_t>(stage.tasks.size());
  status.tasks_done = stage.done;
  status.tasks_reused = stage.reused;
  status.tasks_running = static_cast<uint32_t>(stage.running.size());
  status.retries = stage.retries;
  if (stage.first_lease_s)
    status.wall_s = std::max(0.0, stage.last_result_s - *stage.first_lease_s);
  status.cpu_s = stage.cpu_s;
  for (const uint32_t part : stage.running)
    status.fraction_running += FractionOf(stage.tasks[part].progress);
  return status;
}

JobStatus JobMachine::Status(double now_s) const {
  JobStatus status{.id = spec_.Id(), .state = state_, .error = error_, .spec = spec_};
  status.elapsed_s = (state_ == JobState::kRunning ? now_s : ended_s_) - submitted_s_;
  for (uint32_t s = 0; s < plan_.stages.size(); ++s) status.stages.push_back(StatusOfStage(s));
  return status;
}

std::vector<TaskOutcome> JobMachine::Outcomes() const {
  std::vector<TaskOutcome> outcomes;
  for (uint32_t s = 0; s < stages_.size(); ++s) {
    for (uint32_t part = 0; part < stages_[s].tasks.size(); ++part) {
      const TaskRecord& task = stages_[s].tasks[part];
      if (task.done) outcomes.push_back({task.spec.stage, part, task.id, results_[s][part]});
    }
  }
  return outcomes;
}

}  // namespace orbweave
