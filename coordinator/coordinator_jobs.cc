// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a coordinator does for its clients.

#include "absl/strings/str_cat.h"
#include "coordinator/coordinator.h"
#include "coordinator/job_limits.h"

namespace orbweave {

absl::StatusOr<Digest> Coordinator::SubmitJob(const JobSpec& spec) {
  ORBWEAVE_RETURN_IF_ERROR(CheckSizeOf(spec));
  for (const Digest& input : spec.inputs) {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_stored, blobs_.Confirm(input));
    if (is_stored) continue;
    return absl::NotFoundError(
        absl::StrCat("the job's input blob ", input.ToShortHex(), " is not stored"));
  }
  return job_service_.Submit(spec);
}

template <typename Look>
auto Coordinator::LookAt(const Digest& id, Look&& look)
    -> absl::StatusOr<decltype(look(std::declval<const Job&>()))> {
  const std::lock_guard lock(mutex_);
  dispatcher_.ExpireLeases(clock_.NowSeconds());
  const Job* job = dispatcher_.jobs().Find(id);
  if (job != nullptr) return look(*job);
  return absl::NotFoundError(absl::StrCat("there is no job ", id.ToShortHex()));
}

JobStatus Coordinator::StatusOf(const Job& job, double now_s) const {
  JobStatus status = job.machine->Status(now_s);
  status.unmet = dispatcher_.UnmetOf(job, now_s);
  status.slots = dispatcher_.SlotsAtWork(now_s);
  return status;
}

absl::StatusOr<JobStatus> Coordinator::GetJob(const Digest& id) {
  return LookAt(id, [this](const Job& job) { return StatusOf(job, clock_.NowSeconds()); });
}

absl::StatusOr<std::vector<JobStatus>> Coordinator::ListJobs() {
  const std::lock_guard lock(mutex_);
  const double now_s = clock_.NowSeconds();
  dispatcher_.ExpireLeases(now_s);
  std::vector<JobStatus> jobs;
  for (const auto& [number, id] : dispatcher_.jobs().order()) {
    jobs.push_back(StatusOf(dispatcher_.jobs().At(id), now_s));
  }
  return jobs;
}

absl::StatusOr<std::vector<WorkerStatus>> Coordinator::ListWorkers() {
  const std::lock_guard lock(mutex_);
  return dispatcher_.WorkerStatuses(clock_.NowSeconds());
}

absl::Status Coordinator::CancelJob(const Digest& id) {
  const absl::StatusOr<Digest> cancelled = LookAt(id, [&](const Job&) {
    dispatcher_.CancelJob(id, clock_.NowSeconds());
    return id;
  });
  if (cancelled.ok()) job_service_.SaveEnd(id);
  return cancelled.status();
}

absl::Status Coordinator::ForgetJob(const Digest& id) { return job_service_.Forget(id); }

absl::StatusOr<std::vector<TaskOutcome>> Coordinator::GetOutcomes(const Digest& id) {
  return LookAt(id, [](const Job& job) { return job.machine->Outcomes(); });
}

absl::StatusOr<std::vector<TaskTiming>> Coordinator::GetTimings(const Digest& id) {
  return LookAt(id, [](const Job& job) { return std::vector(job.machine->Timings()); });
}

absl::StatusOr<std::vector<MeasuredTask>> Coordinator::GetCosts(const Digest& id) {
  return LookAt(id, [](const Job& job) { return job.machine->Costs(); });
}

}  // namespace orbweave
