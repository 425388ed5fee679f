// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/metrics/metrics_counters.h"

#include <string>

namespace orbweave {
namespace {

/// From what a fast disk takes to what a lease outlasts.
const prometheus::Histogram::BucketBoundaries& SaveBuckets_s() {
  static const auto* const kBuckets = new prometheus::Histogram::BucketBoundaries{
      0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0};
  return *kBuckets;
}

}  // namespace

MetricsCounters::MetricsCounters()
    : registry_(std::make_shared<prometheus::Registry>()),
      events_(prometheus::BuildCounter()
                  .Name("orbweave_events_total")
                  .Help("Events of the coordinator's log")
                  .Register(*registry_)),
      saves_(prometheus::BuildHistogram()
                 .Name("orbweave_journal_save_seconds")
                 .Help("Time until something saved in the journal was durable")
                 .Register(*registry_)),
      save_errors_(prometheus::BuildCounter()
                       .Name("orbweave_journal_save_errors_total")
                       .Help("What could not be saved in the journal")
                       .Register(*registry_)),
      spans_(prometheus::BuildCounter()
                 .Name("orbweave_spans_total")
                 .Help("Spans of jobs by what became of them")
                 .Register(*registry_)) {
  // That nothing failed is told too: a counter that appears with its first error never rises.
  for (const char* what : {"job", "start", "result", "ends", "blames", "forget", "probe"})
    save_errors_.Add({{"what", what}});
  for (const char* outcome : {"sent", "dropped", "refused"}) spans_.Add({{"outcome", outcome}});
}

void MetricsCounters::CountEvent(const LogEvent& event) {
  events_.Add({{"event", event.event}, {"level", LogLevelName(event.level)}}).Increment();
}

void MetricsCounters::CountSave(std::string_view what, double wait_s, const absl::Status& status) {
  const std::string label(what);
  saves_.Add({{"what", label}}, SaveBuckets_s()).Observe(wait_s);
  if (!status.ok()) save_errors_.Add({{"what", label}}).Increment();
}

void MetricsCounters::CountSpans(std::string_view outcome, uint64_t spans) {
  spans_.Add({{"outcome", std::string(outcome)}}).Increment(static_cast<double>(spans));
}

}  // namespace orbweave
