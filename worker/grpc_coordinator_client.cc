// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/grpc_coordinator_client.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/pipeline/damaged_blob.h"
#include "objects/s3_address.h"
#include "proto/codec/coordinator_codec.h"
#include "proto/codec/garbage_codec.h"
#include "worker/grpc_blob_transfer.h"
#include "worker/grpc_channel.h"
#include "worker/grpc_status.h"

namespace orbweave {
namespace {

using Stub = v1::Coordinator::Stub;

/// Digests per StatBlobs message.
constexpr size_t kMaxDigests = 65536;

/// A call that is answered at once, one that reads or writes a file, one that looks at all files.
constexpr double kQuick_s = 30.0;
constexpr double kFile_s = 300.0;
constexpr double kFolder_s = 3600.0;

/// All values of a stream; the first that cannot be decoded says why.
template <typename Value, typename Proto>
absl::StatusOr<std::vector<Value>> ReadAll(grpc::ClientReader<Proto>& reader) {
  std::vector<Value> values;
  absl::Status decoded;
  for (Proto proto; reader.Read(&proto);) {
    absl::StatusOr<Value> value = FromProto(proto);
    decoded.Update(value.status());
    if (value.ok()) values.push_back(*std::move(value));
  }
  ORBWEAVE_RETURN_IF_ERROR(FromWire(reader.Finish()));
  ORBWEAVE_RETURN_IF_ERROR(decoded);
  return values;
}

v1::JobRequest RequestFor(const Digest& job) {
  v1::JobRequest request;
  request.set_id(ToProto(job));
  return request;
}

}  // namespace

GrpcCoordinatorClient::GrpcCoordinatorClient(const std::string& address,
                                             const ClientOptions& options)
    : address_(address),
      tls_folder_(options.tls_folder),
      handshake_(address, options.tls_folder),
      roots_(options.roots) {}

absl::StatusOr<GrpcCoordinatorClient::LinkHandle> GrpcCoordinatorClient::FindLink() {
  const std::lock_guard lock(mutex_);
  if (link_ && link_->channel->GetState(true) == GRPC_CHANNEL_READY) return link_;
  const absl::StatusOr<CoordinatorAddress> to = FindCoordinator(address_);
  if (!to.ok() && !link_) return to.status();
  if (!to.ok() || (link_ && link_->to == *to)) return link_;
  if (to->known_by == KnownBy::kFleet && !tls_folder_.empty() && to->address.starts_with("unix:")) {
    return absl::UnavailableError(
        absl::StrCat(address_, " names ", to->address, ", where nobody proves who he is"));
  }
  auto channel = OpenChannel(to->address, tls_folder_, to->known_by);
  auto stub = v1::Coordinator::NewStub(channel);
  link_ = std::make_shared<const Link>(*to, std::move(channel), std::move(stub));
  return link_;
}

absl::StatusOr<GrpcCoordinatorClient::LinkHandle> GrpcCoordinatorClient::Connect() {
  constexpr std::chrono::seconds kHandshake{2};
  ORBWEAVE_ASSIGN_OR_RETURN(LinkHandle link, FindLink());
  if (link->channel->GetState(true) != GRPC_CHANNEL_READY)
    link->channel->WaitForConnected(std::chrono::system_clock::now() + kHandshake);
  return link;
}

absl::StatusOr<GrpcCoordinatorClient::LinkHandle> GrpcCoordinatorClient::Begin(
    grpc::ClientContext& context, double timeout_s) {
  ORBWEAVE_ASSIGN_OR_RETURN(LinkHandle link, Connect());
  context.set_deadline(std::chrono::system_clock::now() +
                       std::chrono::milliseconds(static_cast<int64_t>(1000.0 * timeout_s)));
  return link;
}

template <typename Request, typename Reply>
absl::StatusOr<Reply> GrpcCoordinatorClient::Call(Method<Request, Reply> method,
                                                  const Request& request,
                                                  double timeout_s) {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, timeout_s));
  Reply reply;
  ORBWEAVE_RETURN_IF_ERROR(FromWire((*link->stub.*method)(&context, request, &reply)));
  return reply;
}

absl::StatusOr<std::string> GrpcCoordinatorClient::Get(const Digest& digest) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(Read(digest, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

absl::StatusOr<Digest> GrpcCoordinatorClient::Put(std::string_view bytes) {
  const Digest digest = DigestOf(bytes);
  ORBWEAVE_RETURN_IF_ERROR(Write(digest, bytes.size(), PiecesOf(bytes)));
  return digest;
}

absl::Status GrpcCoordinatorClient::Read(const Digest& digest, const TakePiece& take) {
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Connect());
  const std::optional<absl::Status> read = granted_.Read(*link->stub, digest, take);
  return read ? *read : ReceiveBlob(*link->stub, digest, take);
}

absl::Status GrpcCoordinatorClient::Write(const Digest& digest,
                                          uint64_t size_bytes,
                                          const NextPiece& next) {
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Connect());
  const std::optional<absl::Status> written = granted_.Write(*link->stub, digest, size_bytes, next);
  return written ? *written : SendBlob(*link->stub, digest, size_bytes, next);
}

absl::StatusOr<JoinReply> GrpcCoordinatorClient::Join(const WorkerInfo& worker) {
  const auto reply = Call(&Stub::Join, ToProto(worker), kQuick_s);
  if (!reply.ok()) return handshake_.Explain(reply.status());
  return FromProto(*reply);
}

absl::StatusOr<std::optional<Lease>> GrpcCoordinatorClient::LeaseTask(uint64_t session,
                                                                      uint32_t slot,
                                                                      double wait_s,
                                                                      const std::stop_token& left) {
  if (!std::isfinite(wait_s)) return absl::InvalidArgumentError("a wait is a number of seconds");
  v1::LeaseTaskRequest request;
  request.set_session(session);
  request.set_slot(slot);
  request.set_wait_s(wait_s);
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, wait_s + kQuick_s));
  const std::stop_callback on_left(left, [&context] { context.TryCancel(); });
  v1::LeaseTaskReply reply;
  ORBWEAVE_RETURN_IF_ERROR(
      handshake_.Explain(FromWire(link->stub->LeaseTask(&context, request, &reply))));
  if (!reply.has_lease()) return std::nullopt;
  ORBWEAVE_ASSIGN_OR_RETURN(Lease lease, FromProto(reply.lease()));
  return lease;
}

absl::StatusOr<HeartbeatReply> GrpcCoordinatorClient::Heartbeat(
    uint64_t session, const std::vector<LeaseProgress>& leases) {
  v1::HeartbeatRequest request;
  request.set_session(session);
  for (const LeaseProgress& lease : leases) *request.add_leases() = ToProto(lease);
  const auto reply = Call(&Stub::Heartbeat, request, kQuick_s);
  if (!reply.ok()) return handshake_.Explain(reply.status());
  return FromProto(*reply);
}

absl::Status GrpcCoordinatorClient::CompleteTask(uint64_t session,
                                                 const Lease& lease,
                                                 const TaskResult& result) {
  v1::CompleteTaskRequest request;
  request.set_session(session);
  *request.mutable_lease() = ToProto(lease);
  *request.mutable_result() = ToProto(result);
  return Call(&Stub::CompleteTask, request, kFile_s).status();
}

absl::Status GrpcCoordinatorClient::FailTask(uint64_t session,
                                             const Lease& lease,
                                             const absl::Status& error) {
  v1::FailTaskRequest request;
  request.set_session(session);
  *request.mutable_lease() = ToProto(lease);
  request.set_code(static_cast<uint32_t>(error.code()));
  request.set_message(std::string(error.message()));
  if (const std::optional<Digest> blob = BlobToBlame(error)) request.set_damaged(ToProto(*blob));
  return Call(&Stub::FailTask, request, kQuick_s).status();
}

absl::Status GrpcCoordinatorClient::Leave(uint64_t session) {
  v1::LeaveRequest request;
  request.set_session(session);
  return Call(&Stub::Leave, request, kQuick_s).status();
}

absl::StatusOr<std::vector<std::string>> GrpcCoordinatorClient::DrainWorkers(
    const std::string& name) {
  v1::DrainWorkersRequest request;
  request.set_name(name);
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::DrainWorkersReply reply,
                            Call(&Stub::DrainWorkers, request, kQuick_s));
  return std::vector<std::string>(reply.names().begin(), reply.names().end());
}

absl::Status GrpcCoordinatorClient::StopCoordinator() {
  return Call(&Stub::StopCoordinator, v1::Empty(), kQuick_s).status();
}

absl::StatusOr<Digest> GrpcCoordinatorClient::SubmitJob(const JobSpec& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::JobReply reply,
                            Call(&Stub::SubmitJob, ToProto(job), kFile_s));
  return DigestFromProto(reply.id());
}

absl::StatusOr<JobStatus> GrpcCoordinatorClient::GetJob(const Digest& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::JobStatus reply,
                            Call(&Stub::GetJob, RequestFor(job), kQuick_s));
  return FromProto(reply);
}

absl::StatusOr<std::vector<JobStatus>> GrpcCoordinatorClient::ListJobs() {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, kFile_s));
  return ReadAll<JobStatus>(*link->stub->ListJobs(&context, v1::Empty()));
}

absl::StatusOr<std::vector<WorkerStatus>> GrpcCoordinatorClient::ListWorkers() {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, kFile_s));
  return ReadAll<WorkerStatus>(*link->stub->ListWorkers(&context, v1::Empty()));
}

absl::StatusOr<uint32_t> GrpcCoordinatorClient::CountWantedSlots() {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::WantedSlotsReply reply,
                            Call(&Stub::CountWantedSlots, v1::Empty(), kFile_s));
  return reply.slots();
}

absl::Status GrpcCoordinatorClient::CancelJob(const Digest& job) {
  return Call(&Stub::CancelJob, RequestFor(job), kFile_s).status();
}

absl::Status GrpcCoordinatorClient::ForgetJob(const Digest& job) {
  return Call(&Stub::ForgetJob, RequestFor(job), kFile_s).status();
}

absl::StatusOr<GarbageReport> GrpcCoordinatorClient::CollectGarbage(const GarbageOptions& options) {
  ORBWEAVE_ASSIGN_OR_RETURN(const v1::GarbageReport reply,
                            Call(&Stub::CollectGarbage, ToProto(options), kFolder_s));
  return FromProto(reply);
}

absl::StatusOr<std::vector<TaskOutcome>> GrpcCoordinatorClient::GetOutcomes(const Digest& job) {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, kFile_s));
  return ReadAll<TaskOutcome>(*link->stub->GetOutcomes(&context, RequestFor(job)));
}

absl::StatusOr<std::vector<TaskTiming>> GrpcCoordinatorClient::GetTimings(const Digest& job) {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, kFile_s));
  return ReadAll<TaskTiming>(*link->stub->GetTimings(&context, RequestFor(job)));
}

absl::StatusOr<std::vector<MeasuredTask>> GrpcCoordinatorClient::GetCosts(const Digest& job) {
  grpc::ClientContext context;
  ORBWEAVE_ASSIGN_OR_RETURN(const LinkHandle link, Begin(context, kFile_s));
  return ReadAll<MeasuredTask>(*link->stub->GetCosts(&context, RequestFor(job)));
}

absl::StatusOr<std::vector<bool>> GrpcCoordinatorClient::StatBlobs(
    const std::vector<Digest>& digests) {
  std::vector<bool> stored;
  for (size_t begin = 0; begin < digests.size(); begin += kMaxDigests) {
    const size_t end = std::min(begin + kMaxDigests, digests.size());
    v1::StatBlobsRequest request;
    for (size_t i = begin; i < end; ++i) request.add_digests(ToProto(digests[i]));
    ORBWEAVE_ASSIGN_OR_RETURN(const v1::StatBlobsReply reply,
                              Call(&Stub::StatBlobs, request, kFile_s));
    if (static_cast<size_t>(reply.stored_size()) != end - begin) {
      return absl::UnavailableError("the coordinator answered for another number of blobs");
    }
    stored.insert(stored.end(), reply.stored().begin(), reply.stored().end());
  }
  return stored;
}

absl::Status GrpcCoordinatorClient::LinkFile(const Digest& digest, const std::string& path) {
  if (IsS3Address(path)) {
    v1::LinkFileRequest request;  // an object has one name everywhere
    request.set_digest(ToProto(digest));
    request.set_path(path);
    return Call(&Stub::LinkFile, request, kFile_s).status();
  }
  const std::string file = std::filesystem::path(path).lexically_normal().string();
  for (const auto& [name, folder] : roots_) {
    const std::string top = folder.ends_with('/') ? folder : folder + "/";
    if (!file.starts_with(top)) continue;
    v1::LinkFileRequest request;
    request.set_digest(ToProto(digest));
    request.set_root(name);
    request.set_path(file.substr(top.size()));
    return Call(&Stub::LinkFile, request, kFile_s).status();
  }
  return absl::NotFoundError(absl::StrCat(path, " is beneath no root of the coordinator"));
}

}  // namespace orbweave
