// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/pipeline/coordinator_api.h"

namespace orbweave {

struct Patience {
  std::string address{};   ///< of the coordinator, named in errors
  double wait_s = 0.0;     ///< how long a call waits for a coordinator that is away
  std::stop_token stop{};  ///< ends the waiting
  /// Told why, once for each time the coordinator is away. May be empty.
  std::function<void(const absl::Status&)> on_away{};
};

/// A coordinator whose absence is waited through: a call that finds it Unavailable, or that it
/// dropped when it stopped (Cancelled), is repeated, as all calls may be. Unavailable: it was away
/// for all of `wait_s`; Cancelled: `stop` came first. Else the codes of the call. Thread-safe when
/// the coordinator and `on_away` are.
class PatientCoordinator final : public CoordinatorApi {
 public:
  PatientCoordinator(std::unique_ptr<CoordinatorApi> coordinator, Patience patience)
      : api_(std::move(coordinator)), patience_(std::move(patience)) {}

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;

  [[nodiscard]] absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) override;
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> LeaseTask(uint64_t session,
                                                               uint32_t slot,
                                                               double wait_s) override;
  [[nodiscard]] absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) override;
  [[nodiscard]] absl::Status CompleteTask(uint64_t session,
                                          const Lease& lease,
                                          const TaskResult& result) override;
  [[nodiscard]] absl::Status FailTask(uint64_t session,
                                      const Lease& lease,
                                      const absl::Status& error) override;
  [[nodiscard]] absl::Status Leave(uint64_t session) override;

  [[nodiscard]] absl::Status DrainWorker(const std::string& name) override;
  [[nodiscard]] absl::StatusOr<Digest> SubmitJob(const JobSpec& job) override;
  [[nodiscard]] absl::StatusOr<JobStatus> GetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobStatus>> ListJobs() override;
  [[nodiscard]] absl::Status CancelJob(const Digest& job) override;
  [[nodiscard]] absl::Status ForgetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> GetOutcomes(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskTiming>> GetTimings(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<MeasuredTask>> GetCosts(const Digest& job) override;

  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;
  [[nodiscard]] absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) override;

 private:
  /// What `call()` answers once the coordinator is there.
  template <typename Call>
  [[nodiscard]] auto Wait(Call&& call) -> decltype(call());

  std::unique_ptr<CoordinatorApi> api_;
  Patience patience_;
  std::atomic<bool> is_away_{false};
};

}  // namespace orbweave
