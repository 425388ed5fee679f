// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/metrics_server.h"

#include <prometheus/collectable.h>
#include <prometheus/exposer.h>

#include <exception>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "coordinator/listen_address.h"
#include "coordinator/metrics_snapshot.h"

namespace orbweave {
namespace {

class Snapshot final : public prometheus::Collectable {
 public:
  explicit Snapshot(Coordinator& coordinator) : coordinator_(coordinator) {}

  std::vector<prometheus::MetricFamily> Collect() const override {
    const absl::StatusOr<std::vector<JobStatus>> jobs = coordinator_.ListJobs();
    if (!jobs.ok()) return {};
    return SnapshotMetrics(*jobs, coordinator_.ListWorkers(), coordinator_.blob_traffic());
  }

 private:
  Coordinator& coordinator_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<MetricsServer>> MetricsServer::Start(Coordinator& coordinator,
                                                                    const MetricsCounters& counters,
                                                                    const std::string& address) {
  if (absl::StartsWith(address, "unix:")) {
    return absl::InvalidArgumentError("metrics are served on host:port, not on a unix socket");
  }
  ORBWEAVE_RETURN_IF_ERROR(CheckListenAddress(address, Wire::kPlain));
  std::unique_ptr<MetricsServer> server(new MetricsServer);
  try {
    server->exposer_ = std::make_unique<prometheus::Exposer>(address);
  } catch (const std::exception& error) {
    return absl::UnavailableError(
        absl::StrCat("cannot serve metrics on ", address, ": ", error.what()));
  }
  server->counters_ = counters.registry();
  server->snapshot_ = std::make_shared<Snapshot>(coordinator);
  server->exposer_->RegisterCollectable(server->counters_);
  server->exposer_->RegisterCollectable(server->snapshot_);
  server->address_ = absl::StrCat(
      address.substr(0, address.rfind(':')), ":", server->exposer_->GetListeningPorts().front());
  return server;
}

MetricsServer::~MetricsServer() = default;

}  // namespace orbweave
