// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/job_service.h"

#include <map>
#include <utility>

namespace orbweave {
namespace {

LogEvent DescribeBegin(const char* event, const Job& job) {
  const JobSpec& spec = job.machine->spec();
  return {.event = event,
          .job = spec.Id(),
          .since_epoch = job.since_epoch,
          .traceparent = spec.traceparent,
          .message = spec.label};
}

LogEvent DescribeEnd(const Digest& id, const JobEntry& entry) {
  switch (entry.state) {
    case JobState::kFailed:
      return {.level = LogLevel::kError, .event = "job_failed", .job = id, .message = entry.error};
    case JobState::kCancelled:
      return {.event = "job_cancelled", .job = id};
    default:
      return {.event = "job_done", .job = id};
  }
}

}  // namespace

absl::Status JobService::Resume(bool leases_survive) {
  ORBWEAVE_RETURN_IF_ERROR(ResumeJobs());
  ORBWEAVE_RETURN_IF_ERROR(ResumeBlames());
  return ResumeAttempts(leases_survive);
}

absl::Status JobService::ResumeJobs() {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JobEntry> entries, journal_.LoadJobs());
  for (const JobEntry& entry : entries) {
    std::vector<FailedAttempt> failures;
    if (entry.state == JobState::kRunning) {
      ORBWEAVE_ASSIGN_OR_RETURN(failures,
                                journal_.LoadFailures(entry.spec.Id(), entry.since_epoch));
    }
    const std::lock_guard lock(mutex_);
    absl::StatusOr<JobPlan> plan = find_plan_(entry.spec.kind);
    if (!plan.ok()) continue;  // of a build that knew more kinds
    const double now_s = clock_.NowSeconds();
    Job& job = dispatcher_.BeginJob(entry.spec, *std::move(plan), entry.number, now_s);
    job.verify = entry.state == JobState::kRunning;
    job.since_epoch = entry.since_epoch;
    dispatcher_.CountFailures(entry.spec.Id(), std::move(failures));
    if (entry.state == JobState::kFailed) job.machine->JobFails(entry.error, now_s);
    if (entry.state == JobState::kCancelled) job.machine->JobIsCancelled(now_s);
    job.is_saved = entry.state != JobState::kRunning;
    job.had_ended = job.is_saved;
    if (!job.had_ended) dispatcher_.Log(DescribeBegin("job_resumed", job));
  }
  return absl::OkStatus();
}

absl::Status JobService::ResumeBlames() {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<WorkerBlame> blames, journal_.LoadBlames());
  const std::lock_guard lock(mutex_);
  const double now_s = clock_.NowSeconds();
  for (const WorkerBlame& blame : blames) dispatcher_.roster().Remember(blame, now_s);
  return absl::OkStatus();
}

absl::Status JobService::ResumeAttempts(bool leases_survive) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Attempt> open, journal_.LoadOpenAttempts());
  std::map<std::pair<Digest, Digest>, uint64_t> newest;  // epoch by job and task
  for (const Attempt& attempt : open) newest[{attempt.job, attempt.task}] = attempt.epoch;
  std::vector<AttemptEnd> ended;
  const std::lock_guard lock(mutex_);
  for (const Attempt& attempt : open) {
    const Job* job = dispatcher_.jobs().Find(attempt.job);
    const bool is_newest = newest.at({attempt.job, attempt.task}) == attempt.epoch;
    if (leases_survive && is_newest && job != nullptr && job->IsRunning()) {
      dispatcher_.Await(attempt, clock_.NowSeconds());
    } else {
      ended.push_back({.epoch = attempt.epoch, .reason = "the coordinator was started again"});
    }
  }
  return ended.empty() ? absl::OkStatus() : journal_.SaveEnds(ended);
}

absl::StatusOr<Digest> JobService::Submit(const JobSpec& spec) {
  absl::StatusOr<JobPlan> plan = find_plan_(spec.kind);
  if (!plan.ok()) return absl::InvalidArgumentError(plan.status().message());
  const Digest id = spec.Id();
  const std::lock_guard saving(saving_mutex_);
  std::unique_lock lock(mutex_);
  JobTable& jobs = dispatcher_.jobs();
  const Job* known = jobs.Find(id);
  const bool is_running = known != nullptr && known->IsRunning();
  if (is_running && known->verify) return id;
  if (!is_running && jobs.NumRunning() >= max_running_jobs_) {
    return absl::ResourceExhaustedError(
        absl::StrCat(max_running_jobs_, " jobs are running; wait for one, or cancel one"));
  }
  const uint64_t number = known != nullptr ? known->number : jobs.NextNumber();
  const uint64_t since_epoch = dispatcher_.last_epoch();
  lock.unlock();
  ORBWEAVE_RETURN_IF_ERROR(
      journal_.SaveJob({.spec = spec, .number = number, .since_epoch = since_epoch}));
  lock.lock();
  Job& job = dispatcher_.BeginJob(spec, *std::move(plan), number, clock_.NowSeconds());
  job.verify = true;
  job.reruns = 0;
  job.damage = {};
  job.since_epoch = since_epoch;
  dispatcher_.Log(DescribeBegin("job_submitted", job));
  return id;
}

absl::Status JobService::Forget(const Digest& id) {
  const std::lock_guard saving(saving_mutex_);
  const auto check = [&]() -> absl::Status {
    const std::lock_guard lock(mutex_);
    const Job* job = dispatcher_.jobs().Find(id);
    if (job == nullptr) return absl::NotFoundError("there is no job " + id.ToShortHex());
    if (!job->IsRunning()) return absl::OkStatus();
    return absl::FailedPreconditionError("job " + id.ToShortHex() + " runs: cancel it first");
  };
  ORBWEAVE_RETURN_IF_ERROR(check());
  ORBWEAVE_RETURN_IF_ERROR(journal_.ForgetJob(id));
  const std::lock_guard lock(mutex_);
  dispatcher_.ForgetJob(id);
  dispatcher_.Log({.event = "job_forgotten", .job = id});
  return absl::OkStatus();
}

void JobService::SaveEnd(const Digest& id) {
  const std::lock_guard saving(saving_mutex_);
  std::unique_lock lock(mutex_);
  Job* job = dispatcher_.jobs().Find(id);
  if (job == nullptr || job->is_saved || job->IsRunning()) return;
  const JobMachine& machine = *job->machine;
  const JobEntry entry{
      machine.spec(), machine.state(), machine.error(), job->number, job->since_epoch};
  job->is_saved = true;
  dispatcher_.Log(DescribeEnd(id, entry));
  lock.unlock();
  // When this fails the job is found running after a restart, and its results end it again at once.
  journal_.SaveJob(entry).IgnoreError();
}

}  // namespace orbweave
