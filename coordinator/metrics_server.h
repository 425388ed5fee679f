// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/coordinator.h"
#include "coordinator/metrics_counters.h"

namespace prometheus {
class Collectable;
class Exposer;
}  // namespace prometheus

namespace orbweave {

/// Answers GET /metrics with what metrics_counters.h and metrics_snapshot.h list, until destroyed.
/// Neither encrypted nor authenticated, so on loopback addresses only.
class MetricsServer {
 public:
  /// `address`: host:port; port 0 lets the system choose. InvalidArgument: another form, or not a
  /// loopback address. Unavailable: taken. `coordinator` outlives the server.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<MetricsServer>> Start(
      Coordinator& coordinator, const MetricsCounters& counters, const std::string& address);
  ~MetricsServer();

  /// With the port that was chosen.
  [[nodiscard]] const std::string& address() const { return address_; }

 private:
  MetricsServer() = default;

  std::string address_;
  std::shared_ptr<prometheus::Registry> counters_;
  std::shared_ptr<prometheus::Collectable> snapshot_;
  std::unique_ptr<prometheus::Exposer> exposer_;  ///< last: ends before what it asks
};

}  // namespace orbweave
