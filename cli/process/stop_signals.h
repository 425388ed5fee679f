// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

namespace orbweave {

/// While it lives, the first SIGINT or SIGTERM asks for a stop through `token()`. A SIGINT after
/// that ends the process at once; a SIGTERM does not: engines send it to a process and to its
/// parent, who hands it on. To be made before any other thread, so that all threads leave these
/// signals to it.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// Signals do again what they did.
  ~StopSignals();

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  /// Which of both came first; 0: none so far.
  [[nodiscard]] int first() const { return first_; }

 private:
  sigset_t before_{};
  std::atomic<int> first_{0};
  std::stop_source source_;
  std::jthread listener_;
};

}  // namespace orbweave
