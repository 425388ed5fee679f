// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/planner.h"

#include <chrono>
#include <utility>

#include "core/base/fault_point.h"
#include "core/base/sleep.h"

namespace orbweave {
namespace {

/// With nothing to do it moves as often: not in a lease time would be to stand still.
constexpr std::chrono::milliseconds kLook{200};

/// Before a journal that was away is asked again.
constexpr double kPause_s = 0.5;

}  // namespace

void Planner::Start() {
  pulse_.Beat(clock_.NowSeconds());
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

bool Planner::HasWork() const {
  const JobTable& jobs = dispatcher_.jobs();
  return jobs.ToPlan() || jobs.ToSave() || dispatcher_.HasLooseEnds();
}

void Planner::Run(const std::stop_token& stop) {
  while (true) {
    std::unique_lock lock(mutex_);
    woken_.wait_for(lock, stop, kLook, [this] { return HasWork(); });
    if (stop.stop_requested()) break;
    NoteMoment();
    const std::optional<Digest> to_plan = dispatcher_.jobs().ToPlan();
    const std::optional<Digest> to_save = dispatcher_.jobs().ToSave();
    const LooseEnds ends = dispatcher_.TakeLooseEnds();
    lock.unlock();
    Save(ends);
    if (to_plan) PlanNextStage(*to_plan, stop);
    if (to_save) SaveEnd(*to_save);
  }
  SaveAllEnds();
  pulse_.Rest();
}

void Planner::SaveAllEnds() {
  std::unique_lock lock(mutex_);
  const LooseEnds ends = dispatcher_.TakeLooseEnds();
  std::optional<Digest> to_save = dispatcher_.jobs().ToSave();
  lock.unlock();
  Save(ends);
  while (to_save) {
    SaveEnd(*to_save);
    lock.lock();
    to_save = dispatcher_.jobs().ToSave();
    lock.unlock();
  }
}

void Planner::NoteMoment() {
  const double now_s = clock_.NowSeconds();
  pulse_.Beat(now_s);
  wanted_.Note(dispatcher_.jobs().CountOpenTasks(), now_s);
}

void Planner::SaveEnd(const Digest& job) {
  const PulseAtRest rest(pulse_, clock_);
  job_service_.SaveEnd(job);
}

void Planner::Save(const LooseEnds& ends) {
  const PulseAtRest rest(pulse_, clock_);
  absl::Status saved;
  if (!ends.attempts.empty()) saved.Update(journal_.SaveEnds(ends.attempts));
  if (!ends.blames.empty()) saved.Update(journal_.SaveBlames(ends.blames));
  for (const Digest& task : ends.spoilt) saved.Update(journal_.ForgetResultOf(task));
  if (saved.ok()) return;  // otherwise they count as open after a restart, for one lease time
  const std::lock_guard lock(mutex_);
  dispatcher_.Log({.level = LogLevel::kError,
                   .event = "ends_not_saved",
                   .message = std::string(saved.message())});
}

void Planner::PlanNextStage(const Digest& id, const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const Job* job = dispatcher_.jobs().Find(id);
  const std::optional<uint32_t> stage = job == nullptr ? std::nullopt : job->machine->StageToPlan();
  if (!stage) return;
  const uint64_t run = job->run;
  const uint64_t early_results = dispatcher_.early_results();
  const JobSnapshot snapshot = dispatcher_.jobs().Snapshot(id, *stage);
  lock.unlock();
  absl::StatusOr<PreparedStage> prepared = Prepare(snapshot, stop);
  lock.lock();
  job = dispatcher_.jobs().Find(id);
  if (job == nullptr || job->run != run || !job->IsRunning() || stop.stop_requested()) return;
  if (dispatcher_.early_results() != early_results) return;  // once more, with that result
  if (prepared.ok()) {
    FaultPoint("stage", FaultSide::kBefore);
    dispatcher_.StageBegins(id, *std::move(prepared), clock_.NowSeconds());
    NoteMoment();  // tasks that are done before this thread comes round are wanted, too
    FaultPoint("stage", FaultSide::kAfter);
  } else {
    const std::string& name = snapshot.plan.stages[*stage].stage;
    dispatcher_.JobFails(id,
                         Annotate(prepared.status(), "cannot plan stage " + name).ToString(),
                         clock_.NowSeconds());
  }
}

absl::StatusOr<PreparedStage> Planner::Prepare(const JobSnapshot& snapshot,
                                               const std::stop_token& stop) {
  const PulseAtRest rest(pulse_, clock_);
  while (true) {
    absl::StatusOr<PreparedStage> prepared = PrepareStage(snapshot, blobs_, journal_);
    if (!absl::IsUnavailable(prepared.status()) || stop.stop_requested()) return prepared;
    SleepUnlessStopped(kPause_s, stop);
  }
}

}  // namespace orbweave
