// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>

#include "core/pipeline/coordinator_api.h"
#include "orbweave/v1/coordinator.grpc.pb.h"
#include "worker/coordinator_address.h"
#include "worker/grpc_granted_blobs.h"
#include "worker/refused_handshake.h"

namespace orbweave {

struct ClientOptions {
  std::string tls_folder{};  ///< a TlsFolder; empty: no TLS
  /// Where the coordinator's roots are on this machine: name and absolute folder.
  std::map<std::string, std::string> roots{};
};

/// CoordinatorApi at the other end of a gRPC channel (see OpenChannel). While it is not connected
/// calls are Unavailable, as is a blob that was damaged on its way; a worker's calls are
/// Unauthenticated when it will never be, see RefusedHandshake. Thread-safe.
class GrpcCoordinatorClient final : public CoordinatorApi {
 public:
  /// `address` as the server prints it, or "@FILE" as FindCoordinator reads it, again whenever the
  /// connection is lost: the coordinator may have been started elsewhere.
  explicit GrpcCoordinatorClient(const std::string& address, const ClientOptions& options = {});

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

  [[nodiscard]] absl::StatusOr<JoinReply> Join(const WorkerInfo& worker) override;
  using WorkerApi::LeaseTask;
  [[nodiscard]] absl::StatusOr<std::optional<Lease>> LeaseTask(
      uint64_t session, uint32_t slot, double wait_s, const std::stop_token& left) override;
  [[nodiscard]] absl::StatusOr<HeartbeatReply> Heartbeat(
      uint64_t session, const std::vector<LeaseProgress>& leases) override;
  [[nodiscard]] absl::Status CompleteTask(uint64_t session,
                                          const Lease& lease,
                                          const TaskResult& result) override;
  [[nodiscard]] absl::Status FailTask(uint64_t session,
                                      const Lease& lease,
                                      const absl::Status& error) override;
  [[nodiscard]] absl::Status Leave(uint64_t session) override;

  [[nodiscard]] absl::StatusOr<Digest> SubmitJob(const JobSpec& job) override;
  [[nodiscard]] absl::StatusOr<JobStatus> GetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<JobStatus>> ListJobs() override;
  [[nodiscard]] absl::StatusOr<std::vector<WorkerStatus>> ListWorkers() override;
  [[nodiscard]] absl::StatusOr<std::vector<std::string>> DrainWorkers(
      const std::string& name) override;
  [[nodiscard]] absl::Status StopCoordinator() override;
  [[nodiscard]] absl::StatusOr<uint32_t> CountWantedSlots() override;
  [[nodiscard]] absl::Status CancelJob(const Digest& job) override;
  [[nodiscard]] absl::Status ForgetJob(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<GarbageReport> CollectGarbage(
      const GarbageOptions& options) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskOutcome>> GetOutcomes(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<TaskTiming>> GetTimings(const Digest& job) override;
  [[nodiscard]] absl::StatusOr<std::vector<MeasuredTask>> GetCosts(const Digest& job) override;

  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  /// Also NotFound: `path` is beneath none of the roots, and nobody was asked.
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;

 private:
  template <typename Request, typename Reply>
  using Method = grpc::Status (v1::Coordinator::Stub::*)(grpc::ClientContext*,
                                                         const Request&,
                                                         Reply*);

  /// The way to where the coordinator is now.
  struct Link {
    CoordinatorAddress to{};
    std::shared_ptr<grpc::Channel> channel{};
    std::unique_ptr<v1::Coordinator::Stub> stub{};
  };
  using LinkHandle = std::shared_ptr<const Link>;

  /// The present link, or another one where the coordinator has moved. Unavailable: it cannot be
  /// found.
  [[nodiscard]] absl::StatusOr<LinkHandle> FindLink();
  /// The same, with time for a connection that was lost to come back: gRPC drives a handshake only
  /// while somebody waits for the channel, so calls that fail at once, with pauses between them,
  /// never end one that takes several round trips.
  [[nodiscard]] absl::StatusOr<LinkHandle> Connect();
  /// Begins a call of at most `timeout_s`, once connected.
  [[nodiscard]] absl::StatusOr<LinkHandle> Begin(grpc::ClientContext& context, double timeout_s);
  template <typename Request, typename Reply>
  [[nodiscard]] absl::StatusOr<Reply> Call(Method<Request, Reply> method,
                                           const Request& request,
                                           double timeout_s);

  const std::string address_;
  const std::string tls_folder_;
  RefusedHandshake handshake_;
  std::mutex mutex_;
  LinkHandle link_;
  std::map<std::string, std::string> roots_;
  GrantedBlobs granted_;
};

}  // namespace orbweave
