// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "coordinator/coordinator.h"
#include "coordinator/http/http_server.h"
#include "coordinator/journal/journal.h"
#include "coordinator/metrics/metrics_counters.h"
#include "coordinator/traces/span_sender.h"
#include "core/base/clock.h"

namespace orbweave {

/// By what others watch a coordinator.
struct MonitoringArgument {
  std::string http{};  ///< address to serve HttpPages on; empty: nowhere
  HttpServerOptions http_server{};
  std::string otlp{};  ///< URL of a collector of traces; empty: none
};

/// Declares `--http`, `--http-open` and `--otlp`.
void AddMonitoringArguments(CLI::App& command, MonitoringArgument& argument);

/// Counts what happens to a coordinator, sends its spans and shows its pages.
class Monitoring {
 public:
  /// `log`: where events go besides. InvalidArgument: the collector's URL is none.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<Monitoring>> Start(
      const MonitoringArgument& argument, EventLog log);

  /// The coordinator's log. This object outlives who writes to it.
  [[nodiscard]] EventLog Log();
  /// The journal, its waits and errors counted. This object outlives it.
  [[nodiscard]] std::unique_ptr<Journal> Meter(std::unique_ptr<Journal> journal);
  /// Begins to serve the pages; null when nobody asked for them. This object, the coordinator and
  /// the clock outlive the server. Errors: those of HttpServer::Start.
  [[nodiscard]] absl::StatusOr<std::unique_ptr<HttpServer>> ServePages(Coordinator& coordinator,
                                                                       const Clock& clock);

 private:
  Monitoring(const MonitoringArgument& argument, EventLog log);
  [[nodiscard]] absl::Status StartSpans();

  MonitoringArgument argument_;
  EventLog log_;
  MetricsCounters counters_;
  std::unique_ptr<SpanSender> spans_;  ///< null when nobody asked for it
};

}  // namespace orbweave
