// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/coordinator.h"
#include "coordinator/grpc/grpc_server.h"
#include "core/pipeline/build_version.h"
#include "security/key_store.h"
#include "security/unix_time.h"
#include "tests/support/command.h"
#include "tests/support/toy_job.h"
#include "worker/grpc_coordinator_client.h"

namespace orbweave::testing {

/// A key store of fleet "city" in a folder: its own coordinator, client and admin, and workers
/// "node" and "other".
inline std::string MakeKeys(const std::string& store) {
  const int64_t now_unix_s = UnixNow();
  ORBWEAVE_CHECK(MakeKeyStore(store, "city", {"127.0.0.1"}, now_unix_s).ok());
  for (const char* name : {"node", "other"})
    ORBWEAVE_CHECK(AddKeys(store, {.name = name}, now_unix_s).ok());
  return store;
}

/// A worker of this very version with one slot.
inline WorkerInfo Worker(const std::string& name) {
  return {.name = name, .version = std::string(BuildVersion()), .slots = 1};
}

/// A coordinator of toy jobs behind TLS on a loopback port.
class TlsServer {
 public:
  explicit TlsServer(ServerOptions options = {}, CoordinatorOptions coordinator = {})
      : keys_(MakeKeys(folder_ / "keys")), options_(std::move(options)) {
    coordinator.state_dir = folder_ / "state";
    coordinator.find_plan = FindToyPlan;
    coordinator_options_ = coordinator;
    options_.tls_folder = keys_ + "/coordinator";
    options_.used_tokens_folder = folder_ / "state/used_tokens";
    Start("127.0.0.1:0");
  }
  ~TlsServer() { Stop(); }

  /// Ends the coordinator and its listener and opens both again on the same state and port.
  void Restart() {
    const std::string address = server_->address();
    Stop();
    Start(address);
  }

  [[nodiscard]] const TemporaryFolder& folder() const { return folder_; }
  [[nodiscard]] const std::string& keys() const { return keys_; }
  [[nodiscard]] const std::string& address() const { return server_->address(); }
  [[nodiscard]] Coordinator& coordinator() { return *coordinator_; }
  [[nodiscard]] std::unique_ptr<GrpcCoordinatorClient> As(const std::string& name) const {
    return std::make_unique<GrpcCoordinatorClient>(address(),
                                                   ClientOptions{.tls_folder = keys_ + "/" + name});
  }

 private:
  void Start(const std::string& address) {
    auto opened = Coordinator::Open(coordinator_options_, clock_);
    ORBWEAVE_CHECK(opened.ok());
    coordinator_ = *std::move(opened);
    auto server = GrpcServer::Start(*coordinator_, address, options_);
    ORBWEAVE_CHECK(server.ok());
    server_ = *std::move(server);
  }
  void Stop() {
    coordinator_->BeginShutdown();
    server_.reset();
    coordinator_.reset();
  }

  TemporaryFolder folder_;
  std::string keys_;
  ServerOptions options_;
  CoordinatorOptions coordinator_options_;
  SteadyClock clock_;
  std::unique_ptr<Coordinator> coordinator_;
  std::unique_ptr<GrpcServer> server_;
};

}  // namespace orbweave::testing
