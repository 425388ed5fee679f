// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/grpc/grpc_server.h"

#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/resource_quota.h>
#include <grpcpp/security/server_credentials.h>
#include <grpcpp/server_builder.h>

#include <chrono>
#include <filesystem>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "coordinator/grpc/grpc_tls.h"
#include "coordinator/listen_address.h"
#include "coordinator/open_revocations.h"

namespace orbweave {
namespace {

/// Pings tell a cut line from a quiet one; clients are allowed to send theirs.
void SetKeepalive(grpc::ServerBuilder& builder) {
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, 10'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 5'000);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS, 5'000);
}

void SetLimits(grpc::ServerBuilder& builder, const ServerLimits& limits) {
  builder.SetMaxReceiveMessageSize(limits.message_bytes);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONCURRENT_STREAMS, limits.streams_per_connection);
  grpc::ResourceQuota quota("calls");
  quota.SetMaxThreads(limits.threads);
  builder.SetResourceQuota(quota);
}

/// Null where the TLS folder is not made for it.
absl::StatusOr<std::unique_ptr<EnrollmentService>> OpenEnrollment(const ServerOptions& options) {
  const TlsFolder folder{options.tls_folder};
  std::error_code error;
  if (options.used_tokens_folder.empty() ||
      !std::filesystem::exists(folder.AuthorityKeyPath(), error) ||
      !std::filesystem::exists(folder.TokenKeyPath(), error)) {
    return nullptr;
  }
  return EnrollmentService::Open(
      {.tls = folder, .used_folder = options.used_tokens_folder, .log = options.log});
}

/// A connection ends in time, so that none outlives for long the certificate it began with; calls
/// that run then have their time to end.
void SetConnectionAge(grpc::ServerBuilder& builder) {
  constexpr int kHour_ms = 3'600'000;
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_MS, kHour_ms);
  builder.AddChannelArgument(GRPC_ARG_MAX_CONNECTION_AGE_GRACE_MS, kHour_ms);
}

}  // namespace

absl::StatusOr<std::unique_ptr<GrpcServer>> GrpcServer::Start(ServedApi& api,
                                                              const std::string& address,
                                                              const ServerOptions& options) {
  const bool has_tls = !options.tls_folder.empty();
  ORBWEAVE_RETURN_IF_ERROR(CheckListenAddress(address, has_tls ? Wire::kEncrypted : Wire::kPlain));
  std::shared_ptr<grpc::ServerCredentials> credentials = grpc::InsecureServerCredentials();
  std::unique_ptr<EnrollmentService> enrollment_service;
  std::shared_ptr<RevocationList> revocations;
  if (has_tls) {
    ORBWEAVE_ASSIGN_OR_RETURN(enrollment_service, OpenEnrollment(options));
    ORBWEAVE_ASSIGN_OR_RETURN(revocations,
                              OpenRevocations(TlsFolder{options.tls_folder}, options.log));
    const Strangers strangers = enrollment_service ? Strangers::kLetToEnrol : Strangers::kRefused;
    ORBWEAVE_ASSIGN_OR_RETURN(credentials,
                              MakeTlsCredentials({options.tls_folder}, strangers, revocations));
  }
  std::unique_ptr<GrpcServer> server(
      new GrpcServer(api, options, std::move(revocations), std::move(enrollment_service)));
  grpc::EnableDefaultHealthCheckService(true);
  grpc::ServerBuilder builder;
  SetKeepalive(builder);
  if (has_tls) SetConnectionAge(builder);
  SetLimits(builder, options.limits);
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
  int port = 0;
  builder.AddListeningPort(address, credentials, &port);
  builder.RegisterService(&server->service_);
  if (has_tls) builder.RegisterService(&server->enrollment_);
  server->server_ = builder.BuildAndStart();
  if (server->server_ == nullptr || port == 0) {
    return absl::UnavailableError(
        absl::StrCat("cannot listen on ", address, ": in use, or not permitted"));
  }
  const bool is_socket = absl::StartsWith(address, "unix:");
  server->address_ =
      is_socket ? address : absl::StrCat(address.substr(0, address.rfind(':')), ":", port);
  return server;
}

GrpcServer::GrpcServer(ServedApi& api,
                       const ServerOptions& options,
                       std::shared_ptr<RevocationList> revocations,
                       std::unique_ptr<EnrollmentService> enrollment_service)
    : service_(api, std::move(revocations), options.roots, options.limits.streams),
      enrollment_(std::move(enrollment_service)) {}

GrpcServer::~GrpcServer() {
  if (server_ == nullptr) return;
  server_->Shutdown(std::chrono::system_clock::now() + std::chrono::seconds(2));
  server_->Wait();
}

}  // namespace orbweave
