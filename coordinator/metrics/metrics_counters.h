// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <prometheus/counter.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>

#include <cstdint>
#include <memory>
#include <string_view>

#include "core/base/status.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// What a coordinator counts from its start on. Thread-safe.
///   orbweave_events_total{event, level}       events of the log
///   orbweave_journal_save_seconds{what}       histogram: until something saved was durable
///   orbweave_journal_save_errors_total{what}  what could not be saved
///   orbweave_spans_total{outcome}             what became of spans; see SpanSenderOptions::count
class MetricsCounters {
 public:
  MetricsCounters();

  void CountEvent(const LogEvent& event);
  /// A SaveObserver.
  void CountSave(std::string_view what, double wait_s, const absl::Status& status);
  void CountSpans(std::string_view outcome, uint64_t spans);

  [[nodiscard]] std::shared_ptr<prometheus::Registry> registry() const { return registry_; }

 private:
  std::shared_ptr<prometheus::Registry> registry_;
  prometheus::Family<prometheus::Counter>& events_;
  prometheus::Family<prometheus::Histogram>& saves_;
  prometheus::Family<prometheus::Counter>& save_errors_;
  prometheus::Family<prometheus::Counter>& spans_;
};

}  // namespace orbweave
