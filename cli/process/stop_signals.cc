// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/stop_signals.h"

#include <unistd.h>

#include <csignal>
#include <ctime>

#include "cli/process/exit_code.h"

namespace orbweave {
namespace {

sigset_t StoppingSignals() {
  sigset_t signals;
  ::sigemptyset(&signals);
  ::sigaddset(&signals, SIGINT);
  ::sigaddset(&signals, SIGTERM);
  return signals;
}

}  // namespace

StopSignals::StopSignals() {
  const sigset_t signals = StoppingSignals();
  ::pthread_sigmask(SIG_BLOCK, &signals, &before_);
  listener_ = std::jthread([this](const std::stop_token& end) {
    const sigset_t awaited = StoppingSignals();
    const timespec look{.tv_sec = 0, .tv_nsec = 100'000'000};
    while (!end.stop_requested()) {
      const int signal = ::sigtimedwait(&awaited, nullptr, &look);
      if (signal < 0) continue;
      if (first_ == 0) first_ = signal;
      const bool is_again = !source_.request_stop();
      if (is_again && signal == SIGINT) ::_exit(kExitInterrupted);
    }
  });
}

StopSignals::~StopSignals() {
  listener_ = {};
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace orbweave
