// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/traces/span_sender.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/traces/http_post.h"
#include "coordinator/traces/otlp_json.h"
#include "core/base/sleep.h"
#include "core/pipeline/build_version.h"

namespace orbweave {
namespace {

uint64_t NanosecondsNow() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<uint64_t>(std::chrono::nanoseconds(now).count());
}

/// Whether the same request may be taken later (OTLP/HTTP, "Failures").
bool IsForNow(int status) {
  return status == 429 || status == 502 || status == 503 || status == 504;
}

}  // namespace

SpanSender::SpanSender(SpanSenderOptions options)
    : options_(std::move(options)), thread_([this](const std::stop_token& stop) { Run(stop); }) {}

SpanSender::~SpanSender() {
  thread_.request_stop();
  thread_.join();
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double>(options_.farewell_s);
  while (!is_away_ && !waiting_.empty() && std::chrono::steady_clock::now() < end) (void)SendSome();
  Count("dropped", waiting_.size());
}

void SpanSender::Take(const LogEvent& event) {
  uint64_t dropped = 0;
  {
    const std::lock_guard lock(mutex_);
    for (TraceSpan& span : spans_.Take(event, NanosecondsNow())) {
      if (waiting_.size() + num_under_way_ < options_.most_spans) {
        waiting_.push_back(std::move(span));
      } else {
        ++dropped;
      }
    }
  }
  woken_.notify_one();
  Count("dropped", dropped);
}

void SpanSender::Run(const std::stop_token& stop) {
  double pause_s = options_.first_pause_s;
  while (!stop.stop_requested()) {
    Gather(stop);
    if (stop.stop_requested()) return;
    if (SendSome()) {
      pause_s = options_.first_pause_s;
    } else {
      SleepUnlessStopped(pause_s, stop);
      pause_s = std::min(2.0 * pause_s, options_.longest_pause_s);
    }
  }
}

void SpanSender::Gather(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  woken_.wait(lock, stop, [this] { return !waiting_.empty(); });
  woken_.wait_for(lock, stop, std::chrono::duration<double>(options_.linger_s), [this] {
    return waiting_.size() >= options_.most_at_once;
  });
}

bool SpanSender::SendSome() {
  std::vector<TraceSpan> batch;
  {
    const std::lock_guard lock(mutex_);
    const auto end = waiting_.begin() +
                     static_cast<std::ptrdiff_t>(std::min(waiting_.size(), options_.most_at_once));
    batch.assign(std::make_move_iterator(waiting_.begin()), std::make_move_iterator(end));
    waiting_.erase(waiting_.begin(), end);
    num_under_way_ = batch.size();
  }
  const bool is_over = Send(batch) != Fate::kAway;
  const std::lock_guard lock(mutex_);
  num_under_way_ = 0;
  if (is_over) return true;
  waiting_.insert(waiting_.begin(),
                  std::make_move_iterator(batch.begin()),
                  std::make_move_iterator(batch.end()));
  return false;
}

SpanSender::Fate SpanSender::Send(const std::vector<TraceSpan>& batch) {
  const absl::StatusOr<PostAnswer> answer = HttpPost(
      options_.collector, "application/json", OtlpJson(batch, BuildVersion()), options_.timeout_s);
  if (!answer.ok()) return NoteAway(std::string(answer.status().message()));
  if (IsForNow(answer->status)) return NoteAway(absl::StrCat("it answers ", answer->status));
  NoteBack();
  const bool is_taken = answer->status >= 200 && answer->status < 300;
  const uint64_t refused =
      is_taken ? std::min<uint64_t>(RejectedSpans(answer->body), batch.size()) : batch.size();
  Count("sent", batch.size() - refused);
  Count("refused", refused);
  NoteRefused(refused, batch.size(), answer->status);
  return refused == 0 ? Fate::kSent : Fate::kRefused;
}

SpanSender::Fate SpanSender::NoteAway(const std::string& why) {
  if (!std::exchange(is_away_, true)) {
    Log(LogLevel::kWarning,
        "collector_away",
        absl::StrCat(options_.collector.ToText(), ": ", why, "; spans wait, then are dropped"));
  }
  return Fate::kAway;
}

void SpanSender::NoteBack() {
  if (std::exchange(is_away_, false))
    Log(LogLevel::kInfo, "collector_back", options_.collector.ToText());
}

void SpanSender::NoteRefused(uint64_t refused, size_t of, int status) {
  const bool was_refusing = std::exchange(is_refusing_, refused > 0);
  if (was_refusing || refused == 0) return;
  Log(LogLevel::kWarning,
      "spans_refused",
      absl::StrCat(options_.collector.ToText(), ": ", refused, " of ", of, ", answer ", status));
}

void SpanSender::Count(std::string_view outcome, uint64_t spans) const {
  if (spans > 0 && options_.count) options_.count(outcome, spans);
}

void SpanSender::Log(LogLevel level, const std::string& event, const std::string& message) const {
  if (options_.log) options_.log({.level = level, .event = event, .message = message});
}

}  // namespace orbweave
