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
class PatientCoordinator final : public ClientApi {
 public:
  PatientCoordinator(std::unique_ptr<ClientApi> coordinator, Patience patience)
      : api_(std::move(coordinator)), patience_(std::move(patience)) {}

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  /// Goes on where it was when the coordinator was away in its middle. Also Unavailable: what was
  /// taken is damaged.
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  /// Is repeated as long as the first piece alone was asked for: the others are not to be had
  /// again, and who is cut off there finds the coordinator Unavailable at once.
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

  [[nodiscard]] absl::StatusOr<std::vector<std::string>> DrainWorkers(
      const std::string& name) override;
  [[nodiscard]] absl::Status StopCoordinator() override;
  [[nodiscard]] absl::StatusOr<Digest> SubmitJob(const JobSpec& job) override;
  [[nodiscard]] absl::StatusOr<JobStatus> GetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobStatus>> ListJobs() override;
  [[nodiscard]] absl::StatusOr<std::vector<WorkerStatus>> ListWorkers() override;
  [[nodiscard]] absl::StatusOr<uint32_t> CountWantedSlots() override;
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
  /// Tells once that the coordinator is away, and why.
  void SayAway(const absl::Status& why);
  [[nodiscard]] absl::Status Away(const absl::Status& why) const;

  std::unique_ptr<ClientApi> api_;
  Patience patience_;
  std::atomic<bool> is_away_{false};
};

}  // namespace orbweave
