// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/server.h>

#include <memory>
#include <string>

#include "coordinator/grpc/grpc_enrollment.h"
#include "coordinator/grpc/grpc_service.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// What a caller may ask of a server at most; beyond, calls end with ResourceExhausted.
struct ServerLimits {
  int message_bytes = 8 << 20;
  int streams_per_connection = 256;  ///< further ones wait
  int threads = 256;                 ///< one per call, but for those that wait for a task
  StreamLimits streams{};
};

struct ServerOptions {
  std::string tls_folder{};  ///< a TlsFolder; empty: no TLS
  /// Where join tokens that were used are remembered. Tokens are taken when the TLS folder has
  /// ca.key and token.key.
  std::string used_tokens_folder{};
  ServerLimits limits{};
  EventLog log{};
  FileRoots roots{};  ///< beneath which clients may name files of this machine; see LinkFile
};

/// Serves a coordinator on an address until destroyed, and beside it grpc.health.v1.Health,
/// which answers SERVING for the server as a whole (service ""). Before that, whatever keeps calls
/// waiting in `api` has to let go (Coordinator::BeginShutdown).
class GrpcServer {
 public:
  /// `address`: see CheckListenAddress; port 0 lets the system choose. InvalidArgument: not
  /// allowed. Unavailable: taken, or not ours to use. Also those of MakeTlsCredentials.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<GrpcServer>> Start(
      ServedApi& api, const std::string& address, const ServerOptions& options = {});
  ~GrpcServer();

  /// Where workers and clients find it.
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  GrpcServer(ServedApi& api,
             const ServerOptions& options,
             std::shared_ptr<RevocationList> revocations,
             std::unique_ptr<EnrollmentService> enrollment_service);

  GrpcService service_;
  GrpcEnrollment enrollment_;
  std::string address_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace orbweave
