// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/stream_watch.h"

#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

using Steady = std::chrono::steady_clock;

Steady::duration Seconds(double seconds) {
  return std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

StreamWatch::StreamWatch(StreamLimits limits)
    : limits_(limits), thread_([this](const std::stop_token& stop) { CallOffTheSilent(stop); }) {}

absl::StatusOr<std::unique_ptr<StreamWatch::Stream>> StreamWatch::Begin(
    std::function<void()> call_off, const std::string& peer) {
  const std::lock_guard lock(mutex_);
  if (!peer.empty() && of_peer_[peer] >= limits_.most_of_one_peer) {
    return absl::UnavailableError(
        absl::StrCat("you have ", limits_.most_of_one_peer, " streams of blobs open"));
  }
  auto stream = std::make_unique<Stream>(*this, std::move(call_off), peer);
  stream->place_ = streams_.insert(streams_.end(), stream.get());
  if (!peer.empty()) ++of_peer_[peer];
  return stream;
}

StreamWatch::Stream::Stream(StreamWatch& watch, std::function<void()> call_off, std::string peer)
    : watch_(watch), call_off_(std::move(call_off)), peer_(std::move(peer)) {}

StreamWatch::Stream::~Stream() {
  const std::lock_guard lock(watch_.mutex_);
  watch_.streams_.erase(place_);
  const auto count = watch_.of_peer_.find(peer_);
  if (count != watch_.of_peer_.end() && --count->second == 0) watch_.of_peer_.erase(count);
}

void StreamWatch::Stream::SetWaiting(bool waits) {
  const std::lock_guard lock(watch_.mutex_);
  waits_since_.reset();
  if (waits) waits_since_ = Steady::now();
}

void StreamWatch::CallOffTheSilent(const std::stop_token& stop) {
  const auto look = Seconds(limits_.longest_wait_s / 8.0);
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    woken_.wait_for(lock, stop, look, [] { return false; });
    const auto silent_since = Steady::now() - Seconds(limits_.longest_wait_s);
    for (Stream* stream : streams_) {
      if (!stream->waits_since_ || *stream->waits_since_ > silent_since) continue;
      if (const auto call_off = std::exchange(stream->call_off_, nullptr)) call_off();
    }
  }
}

}  // namespace orbweave
