// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_service.h"

#include <string>
#include <utility>

#include "coordinator/grpc/grpc_lease_call.h"
#include "coordinator/grpc/grpc_peer.h"
#include "coordinator/grpc/grpc_status.h"
#include "core/pipeline/damaged_blob.h"
#include "objects/s3_address.h"
#include "proto/codec/coordinator_codec.h"
#include "proto/codec/garbage_codec.h"
#include "proto/codec/grants_codec.h"

namespace orbweave {
namespace {

constexpr uint64_t kMaxBlobBytes = uint64_t{8} << 30;

grpc::Status ReaderLeft() { return {grpc::StatusCode::CANCELLED, "the reader left"}; }

/// A stream of what a call answers, one message each.
template <typename Value, typename Proto>
grpc::Status WriteAll(const absl::StatusOr<std::vector<Value>>& values,
                      grpc::ServerWriter<Proto>& writer) {
  if (!values.ok()) return OnWire(values.status());
  for (const Value& value : *values) {
    if (!writer.Write(ToProto(value))) return ReaderLeft();
  }
  return grpc::Status::OK;
}

}  // namespace

absl::Status GrpcService::CheckSession(const grpc::ServerContextBase& context,
                                       uint64_t session) const {
  if (peers_ == Peers::kTrusted) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const Identity peer, CertifiedPeerOf(*context.auth_context()));
  return owners_.Check(session, peer);
}

absl::StatusOr<JoinReply> GrpcService::JoinAs(const Context& context, const WorkerInfo& worker) {
  if (peers_ == Peers::kTrusted) return api_.Join(worker);
  ORBWEAVE_ASSIGN_OR_RETURN(const Identity peer, CertifiedPeerOf(*context.auth_context()));
  ORBWEAVE_RETURN_IF_ERROR(SessionOwners::CheckName(peer, worker.name));
  ORBWEAVE_ASSIGN_OR_RETURN(const JoinReply joined, api_.Join(worker));
  owners_.Begin(joined.session, worker.name, peer);
  return joined;
}

grpc::Status GrpcService::Join(Context* context,
                               const v1::JoinRequest* request,
                               v1::JoinReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const WorkerInfo worker, FromProto(*request));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const JoinReply joined, JoinAs(*context, worker));
  *reply = ToProto(joined);
  return grpc::Status::OK;
}

grpc::ServerUnaryReactor* GrpcService::LeaseTask(grpc::CallbackServerContext* context,
                                                 const v1::LeaseTaskRequest* request,
                                                 v1::LeaseTaskReply* reply) {
  if (const absl::Status may_ask = CheckSession(*context, request->session()); !may_ask.ok()) {
    grpc::ServerUnaryReactor* refusal = context->DefaultReactor();
    refusal->Finish(OnWire(may_ask));
    return refusal;
  }
  auto* const call = new GrpcLeaseCall(api_, *request, *reply);  // deletes itself
  auto standing = BeginCall(*context, call->CallOff());
  if (standing.ok()) {
    call->Ask(*std::move(standing));
  } else {
    call->Finish(OnWire(standing.status()));
  }
  return call;
}

grpc::Status GrpcService::Heartbeat(Context* context,
                                    const v1::HeartbeatRequest* request,
                                    v1::HeartbeatReply* reply) {
  ORBWEAVE_GRPC_RETURN_IF_ERROR(CheckSession(*context, request->session()));
  std::vector<LeaseProgress> leases;
  for (const v1::LeaseProgress& held : request->leases()) {
    ORBWEAVE_GRPC_ASSIGN_OR_RETURN(leases.emplace_back(), FromProto(held));
  }
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const HeartbeatReply heard,
                                 api_.Heartbeat(request->session(), leases));
  *reply = ToProto(heard);
  return grpc::Status::OK;
}

grpc::Status GrpcService::CompleteTask(Context* context,
                                       const v1::CompleteTaskRequest* request,
                                       v1::Empty*) {
  ORBWEAVE_GRPC_RETURN_IF_ERROR(CheckSession(*context, request->session()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Lease lease, FromProto(request->lease()));
  if (!request->has_result())
    return OnWire(absl::InvalidArgumentError("a task that is done without its result"));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const TaskResult result, FromProto(request->result()));
  return OnWire(api_.CompleteTask(request->session(), lease, result));
}

grpc::Status GrpcService::FailTask(Context* context,
                                   const v1::FailTaskRequest* request,
                                   v1::Empty*) {
  ORBWEAVE_GRPC_RETURN_IF_ERROR(CheckSession(*context, request->session()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Lease lease, FromProto(request->lease()));
  absl::Status error(static_cast<absl::StatusCode>(request->code()), request->message());
  if (!request->damaged().empty()) {
    ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest blob, DigestFromProto(request->damaged()));
    error = BlameBlob(std::move(error), blob);
  }
  return OnWire(api_.FailTask(request->session(), lease, error));
}

grpc::Status GrpcService::Leave(Context* context, const v1::LeaveRequest* request, v1::Empty*) {
  ORBWEAVE_GRPC_RETURN_IF_ERROR(CheckSession(*context, request->session()));
  return OnWire(api_.Leave(request->session()));
}

grpc::Status GrpcService::SubmitJob(Context*, const v1::JobSpec* request, v1::JobReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const JobSpec job, FromProto(*request));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, api_.SubmitJob(job));
  reply->set_id(ToProto(id));
  return grpc::Status::OK;
}

grpc::Status GrpcService::GetJob(Context*, const v1::JobRequest* request, v1::JobStatus* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const JobStatus status, api_.GetJob(id));
  *reply = ToProto(status);
  return grpc::Status::OK;
}

grpc::Status GrpcService::ListJobs(Context*,
                                   const v1::Empty*,
                                   grpc::ServerWriter<v1::JobStatus>* writer) {
  return WriteAll(api_.ListJobs(), *writer);
}

grpc::Status GrpcService::ListWorkers(Context*,
                                      const v1::Empty*,
                                      grpc::ServerWriter<v1::WorkerStatus>* writer) {
  return WriteAll(api_.ListWorkers(), *writer);
}

grpc::Status GrpcService::CountWantedSlots(Context*,
                                           const v1::Empty*,
                                           v1::WantedSlotsReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const uint32_t slots, api_.CountWantedSlots());
  reply->set_slots(slots);
  return grpc::Status::OK;
}

grpc::Status GrpcService::DrainWorkers(Context*,
                                       const v1::DrainWorkersRequest* request,
                                       v1::DrainWorkersReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                                 api_.DrainWorkers(request->name()));
  reply->mutable_names()->Add(names.begin(), names.end());
  return grpc::Status::OK;
}

grpc::Status GrpcService::StopCoordinator(Context*, const v1::Empty*, v1::Empty*) {
  return OnWire(api_.StopCoordinator());
}

grpc::Status GrpcService::CancelJob(Context*, const v1::JobRequest* request, v1::Empty*) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  return OnWire(api_.CancelJob(id));
}

grpc::Status GrpcService::ForgetJob(Context*, const v1::JobRequest* request, v1::Empty*) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  return OnWire(api_.ForgetJob(id));
}

grpc::Status GrpcService::CollectGarbage(Context*,
                                         const v1::GarbageRequest* request,
                                         v1::GarbageReport* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const GarbageReport report,
                                 api_.CollectGarbage(FromProto(*request)));
  *reply = ToProto(report);
  return grpc::Status::OK;
}

grpc::Status GrpcService::GetOutcomes(Context*,
                                      const v1::JobRequest* request,
                                      grpc::ServerWriter<v1::TaskOutcome>* writer) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  return WriteAll(api_.GetOutcomes(id), *writer);
}

grpc::Status GrpcService::GetTimings(Context*,
                                     const v1::JobRequest* request,
                                     grpc::ServerWriter<v1::TaskTiming>* writer) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  return WriteAll(api_.GetTimings(id), *writer);
}

grpc::Status GrpcService::GetCosts(Context*,
                                   const v1::JobRequest* request,
                                   grpc::ServerWriter<v1::MeasuredTask>* writer) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest id, DigestFromProto(request->id()));
  return WriteAll(api_.GetCosts(id), *writer);
}

grpc::Status GrpcService::StatBlobs(Context*,
                                    const v1::StatBlobsRequest* request,
                                    v1::StatBlobsReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const std::vector<Digest> digests,
                                 DigestsFromProto(request->digests()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const std::vector<bool> stored, api_.StatBlobs(digests));
  for (const bool is_stored : stored) reply->add_stored(is_stored);
  return grpc::Status::OK;
}

grpc::Status GrpcService::LinkFile(Context*, const v1::LinkFileRequest* request, v1::Empty*) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(request->digest()));
  if (IsS3Address(request->path())) return OnWire(api_.LinkFile(digest, request->path()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const std::string path,
                                 ResolveBeneath(roots_, request->root(), request->path()));
  return OnWire(api_.LinkFile(digest, path));
}

absl::StatusOr<std::unique_ptr<StandingCalls::Call>> GrpcService::BeginCall(
    const grpc::ServerContextBase& context, std::function<void()> call_off) {
  if (calls_ == nullptr) return nullptr;
  const auto connection = context.auth_context();
  ORBWEAVE_ASSIGN_OR_RETURN(Identity identity, CertifiedPeerOf(*connection));
  return calls_->Begin(
      {.identity = std::move(identity), .certificate_pem = std::string(CertificateOf(*connection))},
      std::move(call_off));
}

absl::StatusOr<GrpcService::BlobStream> GrpcService::BeginStream(Context& context) {
  BlobStream stream;
  const auto call_off = [&context] { context.TryCancel(); };
  std::string peer;
  if (peers_ == Peers::kCertified) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Identity identity, CertifiedPeerOf(*context.auth_context()));
    const std::string address = context.peer();  // "ipv4:192.0.2.7:40312"
    peer = identity.ToUri() + " " + address.substr(0, address.rfind(':'));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(stream.watched, streams_.Begin(call_off, peer));
  ORBWEAVE_ASSIGN_OR_RETURN(stream.standing, BeginCall(context, call_off));
  return stream;
}

grpc::Status GrpcService::GetBlob(Context* context,
                                  const v1::GetBlobRequest* request,
                                  grpc::ServerWriter<v1::BlobChunk>* writer) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(request->digest()));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const auto stream, BeginStream(*context));
  return OnWire(api_.Read(digest, [&](std::string_view piece) {
    v1::BlobChunk chunk;
    chunk.set_data(piece.data(), piece.size());
    return stream.watched->Wait([&] { return writer->Write(chunk); })
               ? absl::OkStatus()
               : absl::CancelledError("the reader left, or took nothing for long");
  }));
}

grpc::Status GrpcService::PutBlob(Context* context,
                                  grpc::ServerReader<v1::BlobChunk>* reader,
                                  v1::PutBlobReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const auto stream, BeginStream(*context));
  v1::BlobChunk chunk;
  const auto read = [&] { return stream.watched->Wait([&] { return reader->Read(&chunk); }); };
  if (!read()) return OnWire(absl::InvalidArgumentError("a blob without a name"));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const Digest digest, DigestFromProto(chunk.digest()));
  const uint64_t size_bytes = chunk.size_bytes();
  if (size_bytes > kMaxBlobBytes)
    return OnWire(absl::InvalidArgumentError("a blob of more than 8 GiB"));
  bool is_first = true;
  const auto next = [&]() -> absl::StatusOr<std::string_view> {
    if (std::exchange(is_first, false) && !chunk.data().empty()) return chunk.data();
    if (read()) return chunk.data();
    if (context->IsCancelled())
      return absl::CancelledError("the writer left, or brought nothing for long");
    return std::string_view();
  };
  ORBWEAVE_GRPC_RETURN_IF_ERROR(api_.Write(digest, size_bytes, next));
  reply->set_digest(ToProto(digest));
  return grpc::Status::OK;
}

grpc::Status GrpcService::GrantBlobs(Context*,
                                     const v1::GrantBlobsRequest* request,
                                     v1::GrantBlobsReply* reply) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const BlobQuestion question, FromProto(*request));
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const std::vector<BlobGrant> grants,
                                 api_.GrantBlobs(question.blobs, question.verb));
  *reply = ToProto(grants);
  return grpc::Status::OK;
}

grpc::Status GrpcService::FinishUpload(Context*,
                                       const v1::FinishUploadRequest* request,
                                       v1::Empty*) {
  ORBWEAVE_GRPC_ASSIGN_OR_RETURN(const UploadEnd end, FromProto(*request));
  return OnWire(api_.FinishUpload(end));
}

}  // namespace orbweave
