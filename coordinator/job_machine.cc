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
  if (state_ != JobState::kRunning) return std::nullopt;
  if (!runs_.empty() && runs_.back().done < runs_.back().tasks.size()) return std::nullopt;
  const uint32_t next = NextStage();
  return next < plan_.stages.size() ? std::optional(next) : std::nullopt;
}

uint32_t JobMachine::NextStage() const {
  if (runs_.empty()) return 0;
  const uint32_t last = runs_.back().stage;
  return StageAfter(plan_, last, results_[last]);
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

const std::string& JobMachine::HolderBefore(const StageRun& run, uint32_t part) const {
  static const std::string* const kNobody = new std::string;
  if (!run.before) return *kNobody;
  const std::vector<TaskRecord>& tasks = runs_[*run.before].tasks;
  return part < tasks.size() ? tasks[part].holder.worker : *kNobody;
}

std::optional<TaskRef> JobMachine::NextReady(const std::string& worker,
                                             const std::vector<std::string>& alive,
                                             double now_s) const {
  if (state_ != JobState::kRunning || runs_.empty()) return std::nullopt;
  const StageRun& run = runs_.back();
  const auto number = static_cast<uint32_t>(runs_.size() - 1);
  std::optional<uint32_t> nobodys;
  std::optional<uint32_t> somebodys;
  for (const uint32_t part : run.ready) {
    if (!MayTake(run.tasks[part], worker, alive, now_s)) continue;
    const std::string& before = HolderBefore(run, part);
    if (!run.before || before == worker) return TaskRef{number, part};
    const bool is_free = std::ranges::find(alive, before) == alive.end();
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

bool JobMachine::WasDoneBy(const Digest& task, uint64_t epoch) const {
  const auto it = refs_.find(task);
  return it != refs_.end() && Task(it->second).done && Task(it->second).holder.epoch == epoch;
}

void JobMachine::StageBegins(std::vector<TaskSpec> tasks,
                             std::vector<std::optional<TaskResult>> found,
                             double now_s) {
  const std::optional<uint32_t> stage = StageToPlan();
  ORBWEAVE_CHECK(stage.has_value() && tasks.size() == found.size());
  const auto number = static_cast<uint32_t>(runs_.size());
  const auto before = std::find_if(
      runs_.rbegin(), runs_.rend(), [&](const StageRun& earlier) { return earlier.stage == *stage; });
  StageRun fresh{.stage = *stage};
  if (before != runs_.rend()) fresh.before = static_cast<uint32_t>(runs_.rend() - before - 1);
  StageRun& run = runs_.emplace_back(std::move(fresh));
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
  ORBWEAVE_CHECK(run.ready.erase(ref.part) == 1);
  run.running.insert(ref.part);
  if (!run.first_lease_s) run.first_lease_s = now_s;
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
  ORBWEAVE_CHECK(runs_[ref.run].running.erase(ref.part) == 1);
  timings_.push_back({.run = ref.run,
                      .stage = task.spec.stage,
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
  StageRun& run = runs_[ref.run];
  Task(ref).done = true;
  Task(ref).cost = result.cost;
  ++run.done;
  run.last_result_s = now_s;
  run.cpu_s += result.cost.cpu_s;
  results_[run.stage][ref.part] = std::move(result);
  EndIfAllDone(now_s);
}

void JobMachine::TaskFailed(TaskRef ref, const absl::Status& error, double now_s) {
  if (state_ != JobState::kRunning) return;
  AttemptEnds(ref, false, now_s);
  StageRun& run = runs_[ref.run];
  run.ready.insert(ref.part);
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
    ++run.retries;
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
  const bool last_is_done = runs_.back().done == runs_.back().tasks.size();
  if (last_is_done && NextStage() == plan_.stages.size()) JobEnds(JobState::kDone, now_s);
}

void JobMachine::JobEnds(JobState state, double now_s) {
  state_ = state;
  ended_s_ = now_s;
  for (StageRun& run : runs_) run.running.clear();
}

void JobMachine::AddTo(StageStatus& status, const StageRun& run) {
  status.tasks_total += static_cast<uint32_t>(run.tasks.size());
  status.tasks_done += run.done;
  status.tasks_reused += run.reused;
  status.tasks_running += static_cast<uint32_t>(run.running.size());
  status.retries += run.retries;
  if (run.first_lease_s) status.wall_s += std::max(0.0, run.last_result_s - *run.first_lease_s);
  status.cpu_s += run.cpu_s;
  for (const uint32_t part : run.running)
    status.fraction_running += FractionOf(run.tasks[part].progress);
}

JobStatus JobMachine::Status(double now_s) const {
  JobStatus status{.id = spec_.Id(), .state = state_, .error = error_, .spec = spec_};
  status.elapsed_s = (state_ == JobState::kRunning ? now_s : ended_s_) - submitted_s_;
  for (const StageRule& rule : plan_.stages) status.stages.push_back({.stage = rule.stage});
  for (const StageRun& run : runs_) AddTo(status.stages[run.stage], run);
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
