// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_machine.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

std::string TextOf(const absl::Status& status) {
  return absl::StrCat(absl::StatusCodeToString(status.code()), ": ", status.message());
}

}  // namespace

JobMachine::JobMachine(JobSpec spec, JobPlan plan, RetryPolicy policy, double now_s)
    : spec_(std::move(spec)), plan_(std::move(plan)), policy_(policy), submitted_s_(now_s) {}

std::optional<uint32_t> JobMachine::StageToPlan() const {
  if (state_ != JobState::kRunning) return std::nullopt;
  if (!runs_.empty() && !runs_.back().IsDone()) return std::nullopt;
  const uint32_t next = NextStage();
  return next < plan_.stages.size() ? std::optional(next) : std::nullopt;
}

uint32_t JobMachine::NextStage() const {
  if (runs_.empty()) return 0;
  const uint32_t last = runs_.back().stage;
  return StageAfter(plan_, last, results_[last]);
}

WorkerSlot JobMachine::PlaceBefore(const StageRun& run, uint32_t part) const {
  if (!run.before || part >= runs_[*run.before].tasks.size()) return {};
  const TaskHolder& holder = runs_[*run.before].tasks[part].done_by;
  return {holder.worker, holder.slot};
}

std::optional<TaskRef> JobMachine::NextReady(const WorkerSlot& at,
                                             const std::vector<std::string>& alive,
                                             double now_s) const {
  if (state_ != JobState::kRunning || runs_.empty()) return std::nullopt;
  const StageRun& run = runs_.back();
  const auto number = static_cast<uint32_t>(runs_.size() - 1);
  std::optional<uint32_t> nobodys;
  std::optional<uint32_t> somebodys;
  for (const uint32_t part : run.ready) {
    if (!run.tasks[part].MayTake(at.worker, alive, now_s)) continue;
    const WorkerSlot before = PlaceBefore(run, part);
    if (!run.before || before == at) return TaskRef{number, part};
    const bool is_free = std::ranges::find(alive, before.worker) == alive.end();
    if (!is_free) somebodys = part;
    if (is_free && !nobodys) nobodys = part;
  }
  if (!nobodys && !somebodys) return std::nullopt;
  return TaskRef{number, nobodys ? *nobodys : *somebodys};
}

std::optional<TaskRef> JobMachine::FindReady(const Digest& task) const {
  const auto it = refs_.find(task);
  if (it == refs_.end() || !runs_[it->second.run].ready.contains(it->second.part)) return {};
  return it->second;
}

std::optional<TaskRef> JobMachine::NextStraggler(const std::string& worker,
                                                 uint32_t slots,
                                                 double now_s) const {
  if (state_ != JobState::kRunning || runs_.empty()) return std::nullopt;
  const std::optional<uint32_t> part = runs_.back().FindStraggler(worker, slots, policy_, now_s);
  if (!part) return std::nullopt;
  return TaskRef{static_cast<uint32_t>(runs_.size() - 1), *part};
}

std::set<std::string> JobMachine::FailedOn(TaskRef ref) const {
  const std::vector<std::string>& names = Task(ref).failed_on;
  return {names.begin(), names.end()};
}

bool JobMachine::WasDoneBy(const Digest& task, uint64_t epoch) const {
  const auto it = refs_.find(task);
  return it != refs_.end() && Task(it->second).done && Task(it->second).done_by.epoch == epoch;
}

void JobMachine::StageBegins(std::vector<TaskSpec> tasks,
                             std::vector<std::optional<TaskResult>> found,
                             double now_s) {
  const std::optional<uint32_t> stage = StageToPlan();
  ORBWEAVE_CHECK(stage.has_value() && tasks.size() == found.size());
  const auto number = static_cast<uint32_t>(runs_.size());
  const auto before = std::find_if(runs_.rbegin(), runs_.rend(), [&](const StageRun& earlier) {
    return earlier.stage == *stage;
  });
  StageRun fresh{.stage = *stage};
  if (before != runs_.rend()) fresh.before = static_cast<uint32_t>(runs_.rend() - before - 1);
  StageRun& run = runs_.emplace_back(std::move(fresh));
  num_tasks_ += tasks.size();
  if (results_.size() <= *stage) results_.resize(*stage + 1);
  std::vector<TaskResult>& results = results_[*stage];
  results.assign(tasks.size(), {});
  for (uint32_t part = 0; part < tasks.size(); ++part) {
    TaskRecord& task = run.tasks.emplace_back();
    task.id = tasks[part].Id();
    task.spec = std::move(tasks[part]);
    refs_[task.id] = {number, part};
    if (!found[part]) {
      run.ready.insert(part);
      continue;
    }
    task.done = true;
    task.cost = found[part]->cost;
    results[part] = *std::move(found[part]);
    ++run.done;
    ++run.reused;
  }
  EndIfAllDone(now_s);
}

void JobMachine::TaskLeased(TaskRef ref, const TaskHolder& holder, double now_s) {
  StageRun& run = runs_[ref.run];
  const bool was_ready = run.ready.erase(ref.part) == 1;
  ORBWEAVE_CHECK(was_ready != run.running.contains(ref.part));
  run.running.insert(ref.part);
  if (!run.first_lease_s) run.first_lease_s = now_s;
  Task(ref).attempts.push_back({.holder = holder, .leased_s = now_s});
  run.UpdateStragglerTime(policy_);
}

void JobMachine::TaskProgressed(AttemptRef ref, const Progress& progress) {
  RunningAttempt* attempt = Task(ref.task).FindAttempt(ref.epoch);
  if (attempt != nullptr) attempt->progress = progress;
}

double JobMachine::AttemptEnds(AttemptRef ref, bool ok, double now_s) {
  TaskRecord& task = Task(ref.task);
  RunningAttempt* found = task.FindAttempt(ref.epoch);
  ORBWEAVE_CHECK(found != nullptr);
  const RunningAttempt attempt = std::move(*found);
  task.attempts.erase(task.attempts.begin() + (found - task.attempts.data()));
  if (task.attempts.empty()) runs_[ref.task.run].running.erase(ref.task.part);
  timings_.push_back({.run = ref.task.run,
                      .stage = task.spec.stage,
                      .part = ref.task.part,
                      .worker = attempt.holder.worker,
                      .slot = attempt.holder.slot,
                      .start_s = attempt.leased_s - submitted_s_,
                      .end_s = now_s - submitted_s_,
                      .ok = ok});
  return now_s - attempt.leased_s;
}

void JobMachine::TaskDone(AttemptRef ref, TaskResult result, double now_s) {
  if (state_ != JobState::kRunning) return;
  StageRun& run = runs_[ref.task.run];
  TaskRecord& task = Task(ref.task);
  task.done_by = task.FindAttempt(ref.epoch)->holder;
  run.durations_s.push_back(AttemptEnds(ref, true, now_s));
  while (!task.attempts.empty())
    AttemptEnds({ref.task, task.attempts.front().holder.epoch}, false, now_s);
  task.done = true;
  task.cost = result.cost;
  ++run.done;
  run.last_result_s = now_s;
  run.cpu_s += result.cost.cpu_s;
  run.UpdateStragglerTime(policy_);
  results_[run.stage][ref.task.part] = std::move(result);
  EndIfAllDone(now_s);
}

void JobMachine::TaskFailed(AttemptRef ref, const absl::Status& error, double now_s) {
  if (state_ != JobState::kRunning) return;
  StageRun& run = runs_[ref.task.run];
  TaskRecord& task = Task(ref.task);
  const std::string worker = task.FindAttempt(ref.epoch)->holder.worker;
  AttemptEnds(ref, false, now_s);
  if (task.attempts.empty()) run.ready.insert(ref.task.part);
  run.UpdateStragglerTime(policy_);
  if (ClassifyFailure(error.code()) == FailureClass::kReturned) return;
  CountFailure(task, worker, error, now_s);
  if (state_ == JobState::kRunning) ++run.retries;
}

void JobMachine::CountFailure(TaskRecord& task,
                              const std::string& worker,
                              const absl::Status& error,
                              double now_s) {
  const FailureClass failure = ClassifyFailure(error.code());
  const uint32_t failures = task.failures.Add(failure);
  ++num_failures_;
  task.failed_on.push_back(worker);
  task.not_before_s = now_s + policy_.WaitAfter(task.failures.Total(), task.id.ToSeed());
  if (failure == FailureClass::kPermanent) {
    JobFails(absl::StrCat(task.Describe(), ": ", TextOf(error)), now_s);
    return;
  }
  const std::string last = absl::StrCat("last on ", worker, ": ", TextOf(error));
  if (failures >= policy_.MaxFailures(failure)) {
    const char* verb = failure == FailureClass::kProcessLost ? " lost its process " : " failed ";
    JobFails(absl::StrCat(
                 task.Describe(), verb, failures, " times, ", last, "; ", task.DescribeInputs()),
             now_s);
  } else if (num_failures_ > policy_.MaxJobRetries(num_tasks_)) {
    JobFails(absl::StrCat("the job gave up after ",
                          num_failures_,
                          " failed attempts at ",
                          num_tasks_,
                          " tasks: ",
                          task.Describe(),
                          ", ",
                          last),
             now_s);
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
  if (runs_.back().IsDone() && NextStage() == plan_.stages.size()) JobEnds(JobState::kDone, now_s);
}

void JobMachine::JobEnds(JobState state, double now_s) {
  state_ = state;
  ended_s_ = now_s;
  for (StageRun& run : runs_) {
    for (const uint32_t part : run.running) run.tasks[part].attempts.clear();
    run.running.clear();
  }
}

JobStatus JobMachine::Status(double now_s) const {
  JobStatus status{.id = spec_.Id(), .state = state_, .error = error_, .spec = spec_};
  status.elapsed_s = (state_ == JobState::kRunning ? now_s : ended_s_) - submitted_s_;
  for (const StageRule& rule : plan_.stages) status.stages.push_back({.stage = rule.stage});
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
