// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/job_machine.h"

#include <algorithm>
#include <utility>

#include "coordinator/jobs/choose_part.h"
#include "coordinator/jobs/judge_failure.h"

namespace orbweave {

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

std::optional<TaskRef> JobMachine::NextReady(const WorkerSlot& at,
                                             const std::vector<std::string>& alive,
                                             double now_s,
                                             bool ahead) const {
  if (!MayHaveWork()) return std::nullopt;
  const std::optional<uint32_t> part = ChoosePart(runs_.back(), at, alive, now_s, ahead);
  if (!part) return std::nullopt;
  return TaskRef{static_cast<uint32_t>(runs_.size() - 1), *part};
}

bool JobMachine::MayHaveWork() const {
  if (state_ != JobState::kRunning || runs_.empty()) return false;
  return !runs_.back().ready.empty() || runs_.back().straggler_after_s;
}

bool JobMachine::MayHaveWork(double now_s) const {
  return MayHaveWork() && (runs_.back().HasReady(now_s) || runs_.back().HasStraggler(now_s));
}

const StageRule* JobMachine::StageToGiveOut() const {
  if (state_ != JobState::kRunning || runs_.empty() || runs_.back().ready.empty()) return nullptr;
  return &plan_.stages[runs_.back().stage];
}

std::optional<TaskRef> JobMachine::FindReady(const Digest& task) const {
  const auto it = refs_.find(task);
  if (it == refs_.end() || !runs_[it->second.run].ready.Contains(it->second.part)) return {};
  return it->second;
}

std::optional<TaskRef> JobMachine::NextStraggler(const std::string& worker,
                                                 uint32_t slots,
                                                 double now_s) const {
  if (!MayHaveWork()) return std::nullopt;
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
  if (const absl::Status loop = loops_.Enter(plan_, *stage, tasks); !loop.ok())
    return JobFails(std::string(loop.message()), now_s);
  const auto number = static_cast<uint32_t>(runs_.size());
  num_tasks_ += tasks.size();
  StageRun& run = runs_.emplace_back(StageRun{.stage = *stage});
  for (TaskSpec& spec : tasks) {
    const Digest id = spec.Id();
    const bool is_repeated = refs_.contains(id);
    refs_[id] = {number, static_cast<uint32_t>(run.tasks.size())};
    run.tasks.push_back({.spec = std::move(spec), .id = id, .is_repeated = is_repeated});
  }
  FindHomes();
  TakeFound(std::move(found));
  CountPastFailures(now_s);
  EndIfAllDone(now_s);
}

void JobMachine::FindHomes() {
  StageRun& run = runs_.back();
  const auto earlier = std::find_if(runs_.rbegin() + 1, runs_.rend(), [&](const StageRun& other) {
    return other.stage == run.stage;
  });
  if (earlier != runs_.rend()) run.FindHomes(*earlier);
}

void JobMachine::TakeFound(std::vector<std::optional<TaskResult>> found) {
  StageRun& run = runs_.back();
  if (results_.size() <= run.stage) results_.resize(run.stage + 1);
  std::vector<TaskResult>& results = results_[run.stage];
  results.assign(found.size(), {});
  for (uint32_t part = 0; part < found.size(); ++part) {
    if (!found[part]) {
      run.tasks[part].is_repeated = false;  // its result was lost
      run.SetReady(part);
      continue;
    }
    run.tasks[part].done = true;
    run.tasks[part].cost = found[part]->cost;
    results[part] = *std::move(found[part]);
    ++run.done;
    ++run.reused;
    run.repeated += run.tasks[part].is_repeated ? 1U : 0U;
  }
}

void JobMachine::Remember(const std::vector<FailedAttempt>& failures) {
  for (const FailedAttempt& failure : failures) past_failures_[failure.task].push_back(failure);
}

void JobMachine::CountPastFailures(double now_s) {
  StageRun& run = runs_.back();
  for (TaskRecord& task : run.tasks) {
    const auto past = past_failures_.find(task.id);
    if (past == past_failures_.end()) continue;
    for (const FailedAttempt& failure : past->second) {
      ++run.retries;
      if (task.done) {
        ++num_failures_;
      } else {
        // Who serves is not known yet: what was to be tried elsewhere still is.
        CountFailure(task, failure.worker, {failure.code, failure.reason}, true, now_s);
      }
      if (state_ != JobState::kRunning) return;
    }
    past_failures_.erase(past);
  }
}

void JobMachine::TaskLeased(TaskRef ref, const TaskHolder& holder, double now_s) {
  StageRun& run = runs_[ref.run];
  const bool was_ready = run.TakeReady(ref.part, holder.worker);
  ORBWEAVE_CHECK(was_ready != run.running.contains(ref.part));
  run.running.insert(ref.part);
  if (!run.first_lease_s) run.first_lease_s = now_s;
  Task(ref).attempts.push_back({.holder = holder, .leased_s = now_s});
  run.UpdateStragglerTime(policy_);
}

void JobMachine::TaskProgressed(AttemptRef ref, const Progress& progress) {
  RunningAttempt* attempt = Task(ref.task).FindAttempt(ref.epoch);
  if (attempt != nullptr) attempt->progress = {progress.done, progress.total};
}

double JobMachine::AttemptEnds(AttemptRef ref, bool ok, double now_s) {
  TaskRecord& task = Task(ref.task);
  RunningAttempt* found = task.FindAttempt(ref.epoch);
  ORBWEAVE_CHECK(found != nullptr);
  const RunningAttempt attempt = std::move(*found);
  task.attempts.erase(task.attempts.begin() + (found - task.attempts.data()));
  if (task.attempts.empty()) runs_[ref.task.run].running.erase(ref.task.part);
  double& free_since_s = free_since_s_[{attempt.holder.worker, attempt.holder.slot}];
  const double start_s = std::max(attempt.leased_s, free_since_s);
  free_since_s = now_s;
  timings_.push_back({.run = ref.task.run,
                      .stage = task.spec.stage,
                      .part = ref.task.part,
                      .worker = attempt.holder.worker,
                      .slot = attempt.holder.slot,
                      .start_s = start_s - submitted_s_,
                      .end_s = now_s - submitted_s_,
                      .ok = ok});
  return now_s - start_s;
}

void JobMachine::TaskDone(AttemptRef ref, TaskResult result, double now_s) {
  if (state_ != JobState::kRunning) return;
  StageRun& run = runs_[ref.task.run];
  TaskRecord& task = Task(ref.task);
  task.done_by = task.FindAttempt(ref.epoch)->holder;
  run.NoteDuration(AttemptEnds(ref, true, now_s));
  while (!task.attempts.empty())
    AttemptEnds({ref.task, task.attempts.front().holder.epoch}, false, now_s);
  task.done = true;
  task.cost = result.cost;
  run.failed.erase(ref.task.part);
  ++run.done;
  run.last_result_s = now_s;
  run.cpu_s += result.cost.cpu_s;
  run.wall_s += result.cost.wall_s;
  run.UpdateStragglerTime(policy_);
  results_[run.stage][ref.task.part] = std::move(result);
  EndIfAllDone(now_s);
}

void JobMachine::TaskFailed(AttemptRef ref,
                            const absl::Status& error,
                            double now_s,
                            const std::vector<std::string>& serving) {
  if (state_ != JobState::kRunning) return;
  StageRun& run = runs_[ref.task.run];
  TaskRecord& task = Task(ref.task);
  const std::string worker = task.FindAttempt(ref.epoch)->holder.worker;
  AttemptEnds(ref, false, now_s);
  if (task.attempts.empty()) run.SetReady(ref.task.part);
  run.UpdateStragglerTime(policy_);
  if (ClassifyFailure(error.code()) == FailureClass::kReturned) return;
  const bool another_may_try = std::ranges::any_of(
      serving, [&](const std::string& name) { return name != worker && !task.HasFailedOn(name); });
  CountFailure(task, worker, error, another_may_try, now_s);
  if (state_ == JobState::kRunning) ++run.retries;
}

void JobMachine::CountFailure(TaskRecord& task,
                              const std::string& worker,
                              const absl::Status& error,
                              bool another_may_try,
                              double now_s) {
  task.failures.Add(ClassifyFailure(error.code()));
  ++num_failures_;
  runs_.back().failed.insert(task.spec.part);
  task.failed_on.push_back(worker);
  task.not_before_s = now_s + policy_.WaitAfter(task.failures.Total(), task.id.ToSeed());
  const JobTally tally{num_failures_, num_tasks_, another_may_try};
  const auto reason = JudgeFailure(policy_, task, worker, error, tally);
  if (reason) JobFails(*reason, now_s);
}

void JobMachine::JobFails(const std::string& error, double now_s) {
  constexpr size_t kMostBytes = 8000;
  error_ = error.substr(0, kMostBytes);
  JobEnds(JobState::kFailed, now_s);
}

void JobMachine::JobIsCancelled(double now_s) {
  if (state_ == JobState::kRunning) JobEnds(JobState::kCancelled, now_s);
}

void JobMachine::EndIfAllDone(double now_s) {
  if (state_ != JobState::kRunning || !runs_.back().IsDone()) return;
  if (NextStage() == plan_.stages.size()) JobEnds(JobState::kDone, now_s);
}

void JobMachine::JobEnds(JobState state, double now_s) {
  state_ = state;
  ended_s_ = now_s;
  for (StageRun& run : runs_) {
    for (const uint32_t part : run.running) run.tasks[part].attempts.clear();
    run.running.clear();
  }
}

}  // namespace orbweave
