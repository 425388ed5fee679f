// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/fleet/monitoring.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/http/http_pages.h"
#include "coordinator/journal/journal_meter.h"

namespace orbweave {

void AddMonitoringArguments(CLI::App& command, MonitoringArgument& argument) {
  CLI::Option* const http =
      command.add_option("--http",
                         argument.http,
                         "Serve /metrics, /livez, /readyz and /wanted at http://ADDRESS "
                         "(127.0.0.1:port)");
  command
      .add_flag("--http-open",
                argument.http_server.is_open,
                "Let other machines read these pages: they are neither encrypted nor protected")
      ->needs(http);
  command.add_option(
      "--otlp",
      argument.otlp,
      "Send the spans of jobs, stages and attempts to the collector of OpenTelemetry at "
      "http://HOST:4318; what it does not take in time is dropped");
}

absl::StatusOr<std::unique_ptr<Monitoring>> Monitoring::Start(const MonitoringArgument& argument,
                                                              EventLog log) {
  std::unique_ptr<Monitoring> monitoring(new Monitoring(argument, std::move(log)));
  ORBWEAVE_RETURN_IF_ERROR(monitoring->StartSpans());
  return monitoring;
}

Monitoring::Monitoring(const MonitoringArgument& argument, EventLog log) : argument_(argument) {
  log_ = [this, log = std::move(log)](const LogEvent& event) {
    counters_.CountEvent(event);
    log(event);
  };
}

absl::Status Monitoring::StartSpans() {
  if (argument_.otlp.empty()) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(HttpUrl collector, ParseHttpUrl(argument_.otlp));
  if (collector.target == "/") collector.target = "/v1/traces";
  const auto count = [this](std::string_view outcome, uint64_t spans) {
    counters_.CountSpans(outcome, spans);
  };
  spans_ = std::make_unique<SpanSender>(
      SpanSenderOptions{.collector = std::move(collector), .count = count, .log = log_});
  return absl::OkStatus();
}

EventLog Monitoring::Log() {
  return [this](const LogEvent& event) {
    log_(event);
    if (spans_) spans_->Take(event);
  };
}

std::unique_ptr<Journal> Monitoring::Meter(std::unique_ptr<Journal> journal) {
  return MeterJournal(std::move(journal),
                      [this](std::string_view what, double wait_s, const absl::Status& status) {
                        counters_.CountSave(what, wait_s, status);
                      });
}

absl::StatusOr<std::unique_ptr<HttpServer>> Monitoring::ServePages(Coordinator& coordinator,
                                                                   const Clock& clock) {
  if (argument_.http.empty()) return nullptr;
  const auto pages = std::make_shared<HttpPages>(coordinator, counters_, clock);
  const auto find = [pages](std::string_view path) { return pages->Find(path); };
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<HttpServer> server,
                            HttpServer::Start(argument_.http, argument_.http_server, find));
  log_({.event = "http_ready", .message = absl::StrCat("address=", server->address())});
  return server;
}

}  // namespace orbweave
