// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "coordinator/traces/http_url.h"
#include "coordinator/traces/job_spans.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

struct SpanSenderOptions {
  HttpUrl collector{};         ///< takes OTLP/JSON of traces
  size_t most_spans = 16'384;  ///< that wait to be sent; further ones are dropped
  size_t most_at_once = 512;
  double linger_s = 1.0;   ///< for others to go together
  double timeout_s = 2.0;  ///< for an answer
  double first_pause_s = 1.0;
  double longest_pause_s = 30.0;  ///< between attempts while the collector is away
  double farewell_s = 2.0;        ///< for what waits at the end
  /// Told what became of how many spans: "sent", "dropped" (there was no room while the collector
  /// was away, or the process ended), "refused" (by the collector).
  std::function<void(std::string_view outcome, uint64_t spans)> count{};
  EventLog log{};  ///< collector_away, collector_back, spans_refused
};

/// Sends the spans of jobs to a collector, from a thread of its own: who tells it of events never
/// waits for the network. Thread-safe.
class SpanSender {
 public:
  explicit SpanSender(SpanSenderOptions options);
  /// Sends what waits if the collector takes it at once.
  ~SpanSender();
  SpanSender(const SpanSender&) = delete;
  SpanSender& operator=(const SpanSender&) = delete;

  /// An EventLog.
  void Take(const LogEvent& event);

 private:
  enum class Fate { kSent, kAway, kRefused };

  void Run(const std::stop_token& stop);
  /// Waits until there is something to send, and a while for more.
  void Gather(const std::stop_token& stop);
  /// Sends the oldest spans; whether the collector was there.
  bool SendSome();
  [[nodiscard]] Fate Send(const std::vector<TraceSpan>& batch);
  [[nodiscard]] Fate NoteAway(const std::string& why);
  void NoteBack();
  void NoteRefused(uint64_t refused, size_t of, int status);
  void Count(std::string_view outcome, uint64_t spans) const;
  void Log(LogLevel level, const std::string& event, const std::string& message) const;

  SpanSenderOptions options_;
  std::mutex mutex_;
  std::condition_variable_any woken_;
  JobSpans spans_;
  std::deque<TraceSpan> waiting_;
  size_t num_under_way_ = 0;  ///< they have a place among those that wait
  bool is_away_ = false;      ///< of the thread alone
  bool is_refusing_ = false;  ///< likewise
  std::jthread thread_;       ///< last: ends before what it uses
};

}  // namespace orbweave
