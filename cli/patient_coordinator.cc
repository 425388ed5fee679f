// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/patient_coordinator.h"

#include <chrono>

#include "absl/strings/str_cat.h"
#include "worker/retry.h"

namespace orbweave {
namespace {

/// No call is cancelled by this side: a coordinator that stops does so to those that run.
bool IsAway(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsCancelled(status);
}

}  // namespace

template <typename Call>
auto PatientCoordinator::Wait(Call&& call) -> decltype(call()) {
  using Clock = std::chrono::steady_clock;
  const auto give_up = Clock::now() + std::chrono::duration<double>(patience_.wait_s);
  Backoff backoff;
  while (true) {
    auto answer = call();
    const absl::Status status = internal::StatusOf(answer);
    if (!IsAway(status)) {
      is_away_ = false;
      return answer;
    }
    const absl::Status away = absl::UnavailableError(
        absl::StrCat("no coordinator answers at ", patience_.address, ": ", status.message()));
    if (Clock::now() >= give_up) return away;
    if (!is_away_.exchange(true) && patience_.on_away) patience_.on_away(away);
    if (!backoff.Wait(patience_.stop))
      return absl::CancelledError("interrupted while the coordinator was away");
  }
}

absl::StatusOr<std::string> PatientCoordinator::Get(const Digest& digest) {
  return Wait([&] { return api_->Get(digest); });
}

absl::StatusOr<Digest> PatientCoordinator::Put(std::string_view bytes) {
  return Wait([&] { return api_->Put(bytes); });
}

absl::StatusOr<JoinReply> PatientCoordinator::Join(const WorkerInfo& worker) {
  return Wait([&] { return api_->Join(worker); });
}

absl::StatusOr<std::optional<Lease>> PatientCoordinator::LeaseTask(uint64_t session,
                                                                   uint32_t slot,
                                                                   double wait_s) {
  return Wait([&] { return api_->LeaseTask(session, slot, wait_s); });
}

absl::StatusOr<HeartbeatReply> PatientCoordinator::Heartbeat(
    uint64_t session, const std::vector<LeaseProgress>& leases) {
  return Wait([&] { return api_->Heartbeat(session, leases); });
}

absl::Status PatientCoordinator::CompleteTask(uint64_t session,
                                              const Lease& lease,
                                              const TaskResult& result) {
  return Wait([&] { return api_->CompleteTask(session, lease, result); });
}

absl::Status PatientCoordinator::FailTask(uint64_t session,
                                          const Lease& lease,
                                          const absl::Status& error) {
  return Wait([&] { return api_->FailTask(session, lease, error); });
}

absl::Status PatientCoordinator::Leave(uint64_t session) {
  return Wait([&] { return api_->Leave(session); });
}

absl::Status PatientCoordinator::DrainWorker(const std::string& name) {
  return Wait([&] { return api_->DrainWorker(name); });
}

absl::StatusOr<Digest> PatientCoordinator::SubmitJob(const JobSpec& job) {
  return Wait([&] { return api_->SubmitJob(job); });
}

absl::StatusOr<JobStatus> PatientCoordinator::GetJob(const Digest& job) {
  return Wait([&] { return api_->GetJob(job); });
}

absl::StatusOr<std::vector<JobStatus>> PatientCoordinator::ListJobs() {
  return Wait([&] { return api_->ListJobs(); });
}

absl::Status PatientCoordinator::CancelJob(const Digest& job) {
  return Wait([&] { return api_->CancelJob(job); });
}

absl::StatusOr<std::vector<TaskOutcome>> PatientCoordinator::GetOutcomes(const Digest& job) {
  return Wait([&] { return api_->GetOutcomes(job); });
}

absl::StatusOr<std::vector<TaskTiming>> PatientCoordinator::GetTimings(const Digest& job) {
  return Wait([&] { return api_->GetTimings(job); });
}

absl::StatusOr<std::vector<MeasuredTask>> PatientCoordinator::GetCosts(const Digest& job) {
  return Wait([&] { return api_->GetCosts(job); });
}

absl::StatusOr<std::vector<bool>> PatientCoordinator::StatBlobs(
    const std::vector<Digest>& digests) {
  return Wait([&] { return api_->StatBlobs(digests); });
}

absl::Status PatientCoordinator::LinkFile(const Digest& digest, const std::string& path) {
  return Wait([&] { return api_->LinkFile(digest, path); });
}

absl::Status PatientCoordinator::ForgetJob(const Digest& job) {
  return Wait([&] { return api_->ForgetJob(job); });
}

absl::StatusOr<GarbageReport> PatientCoordinator::CollectGarbage(const GarbageOptions& options) {
  return Wait([&] { return api_->CollectGarbage(options); });
}

}  // namespace orbweave
