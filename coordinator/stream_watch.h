// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "absl/status/statusor.h"

namespace orbweave {

/// What streams of blobs may take of a server's threads; each takes one as long as it lasts.
struct StreamLimits {
  double longest_wait_s = 60.0;  ///< for the other end to bring or take the next piece
  uint32_t most_of_one_peer = 64;
};

/// Calls off streams whose other end neither brings nor takes anything, and counts those of each
/// peer, so that nobody keeps the others out by opening streams and being silent. Thread-safe.
class StreamWatch {
 public:
  /// A stream that goes on; it ends with this.
  class Stream {
   public:
    Stream(StreamWatch& watch, std::function<void()> call_off, std::string peer);
    ~Stream();
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    /// What `transfer()` answers, which waits for the other end.
    template <typename Transfer>
    bool Wait(const Transfer& transfer) {
      SetWaiting(true);
      const bool moved = transfer();
      SetWaiting(false);
      return moved;
    }

   private:
    friend class StreamWatch;
    void SetWaiting(bool waits);

    StreamWatch& watch_;
    std::function<void()> call_off_;
    std::string peer_;
    std::optional<std::chrono::steady_clock::time_point> waits_since_{};
    std::list<Stream*>::iterator place_;
  };

  explicit StreamWatch(StreamLimits limits);

  /// `call_off` makes what waits for the other end return; it is called once at most, and not after
  /// the stream has ended. `peer` empty: nobody is counted. Unavailable: the peer has as many as it
  /// may, and may try again.
  [[nodiscard]] absl::StatusOr<std::unique_ptr<Stream>> Begin(std::function<void()> call_off,
                                                              const std::string& peer);

 private:
  void CallOffTheSilent(const std::stop_token& stop);

  StreamLimits limits_;
  std::mutex mutex_;
  std::list<Stream*> streams_;
  std::map<std::string, uint32_t> of_peer_;
  std::condition_variable_any woken_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
