// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "coordinator/file_roots.h"
#include "coordinator/served_api.h"
#include "coordinator/session_owners.h"
#include "coordinator/standing_calls.h"
#include "coordinator/stream_watch.h"
#include "orbweave/v1/coordinator.grpc.pb.h"

namespace orbweave {

/// Who is at the other end.
enum class Peers {
  kTrusted,    ///< whoever can reach a socket or the loopback: this machine's own people
  kCertified,  ///< holders of certificates, let in by GrpcGate; a worker session is its peer's
               ///< alone
};

/// CoordinatorApi on the wire: each handler decodes, calls and encodes, in a thread of its own but
/// for the one call that waits.
class GrpcService final
    : public v1::Coordinator::WithCallbackMethod_LeaseTask<v1::Coordinator::Service> {
 public:
  /// Files are named to it beneath `roots` alone. Peers are certified where there is a list of
  /// those who are `revoked`; who comes upon it loses the calls that go on.
  GrpcService(ServedApi& api,
              std::shared_ptr<RevocationList> revoked,
              FileRoots roots,
              StreamLimits streams)
      : api_(api),
        peers_(revoked == nullptr ? Peers::kTrusted : Peers::kCertified),
        roots_(std::move(roots)),
        streams_(streams) {
    if (revoked != nullptr) calls_ = std::make_unique<StandingCalls>(std::move(revoked));
  }

  using Context = grpc::ServerContext;
  using WithCallbackMethod_LeaseTask::LeaseTask;

  grpc::Status Join(Context*, const v1::JoinRequest*, v1::JoinReply*) override;
  grpc::ServerUnaryReactor* LeaseTask(grpc::CallbackServerContext*,
                                      const v1::LeaseTaskRequest*,
                                      v1::LeaseTaskReply*) override;
  grpc::Status Heartbeat(Context*, const v1::HeartbeatRequest*, v1::HeartbeatReply*) override;
  grpc::Status CompleteTask(Context*, const v1::CompleteTaskRequest*, v1::Empty*) override;
  grpc::Status FailTask(Context*, const v1::FailTaskRequest*, v1::Empty*) override;
  grpc::Status Leave(Context*, const v1::LeaveRequest*, v1::Empty*) override;

  grpc::Status SubmitJob(Context*, const v1::JobSpec*, v1::JobReply*) override;
  grpc::Status GetJob(Context*, const v1::JobRequest*, v1::JobStatus*) override;
  grpc::Status ListJobs(Context*, const v1::Empty*, grpc::ServerWriter<v1::JobStatus>*) override;
  grpc::Status ListWorkers(Context*,
                           const v1::Empty*,
                           grpc::ServerWriter<v1::WorkerStatus>*) override;
  grpc::Status DrainWorkers(Context*,
                            const v1::DrainWorkersRequest*,
                            v1::DrainWorkersReply*) override;
  grpc::Status StopCoordinator(Context*, const v1::Empty*, v1::Empty*) override;
  grpc::Status CountWantedSlots(Context*, const v1::Empty*, v1::WantedSlotsReply* reply) override;
  grpc::Status CancelJob(Context*, const v1::JobRequest*, v1::Empty*) override;
  grpc::Status ForgetJob(Context*, const v1::JobRequest*, v1::Empty*) override;
  grpc::Status CollectGarbage(Context*, const v1::GarbageRequest*, v1::GarbageReport*) override;
  grpc::Status GetOutcomes(Context*,
                           const v1::JobRequest*,
                           grpc::ServerWriter<v1::TaskOutcome>*) override;
  grpc::Status GetTimings(Context*,
                          const v1::JobRequest*,
                          grpc::ServerWriter<v1::TaskTiming>*) override;
  grpc::Status GetCosts(Context*,
                        const v1::JobRequest*,
                        grpc::ServerWriter<v1::MeasuredTask>*) override;

  grpc::Status StatBlobs(Context*, const v1::StatBlobsRequest*, v1::StatBlobsReply*) override;
  grpc::Status LinkFile(Context*, const v1::LinkFileRequest*, v1::Empty*) override;
  grpc::Status GetBlob(Context*,
                       const v1::GetBlobRequest*,
                       grpc::ServerWriter<v1::BlobChunk>*) override;
  grpc::Status PutBlob(Context*, grpc::ServerReader<v1::BlobChunk>*, v1::PutBlobReply*) override;
  grpc::Status GrantBlobs(Context*, const v1::GrantBlobsRequest*, v1::GrantBlobsReply*) override;
  grpc::Status FinishUpload(Context*, const v1::FinishUploadRequest*, v1::Empty*) override;

 private:
  [[nodiscard]] absl::StatusOr<JoinReply> JoinAs(const Context& context, const WorkerInfo& worker);
  /// See SessionOwners::Check.
  [[nodiscard]] absl::Status CheckSession(const grpc::ServerContextBase& context,
                                          uint64_t session) const;

  /// A stream of blobs of the caller's, while both live.
  struct BlobStream {
    std::unique_ptr<StreamWatch::Stream> watched{};
    std::unique_ptr<StandingCalls::Call> standing{};
  };
  [[nodiscard]] absl::StatusOr<BlobStream> BeginStream(Context& context);
  /// A call of the caller's that lasts; null where peers are trusted.
  [[nodiscard]] absl::StatusOr<std::unique_ptr<StandingCalls::Call>> BeginCall(
      const grpc::ServerContextBase& context, std::function<void()> call_off);

  ServedApi& api_;
  Peers peers_;
  FileRoots roots_;
  SessionOwners owners_;
  StreamWatch streams_;
  std::unique_ptr<StandingCalls> calls_;  ///< null: peers are trusted
};

}  // namespace orbweave
