// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "core/base/clock.h"
#include "core/base/status.h"

namespace orbweave {

struct ProbePatience {
  double keep_s = 1.0;  ///< an answer is given again for so long
  double wait_s = 1.0;  ///< for an answer, before it is said that there is none
};

/// A question to something that may be slow or away, for many who ask often: it is put by a thread
/// of its own, once at a time and only when somebody asks, and its answer is kept for a while.
/// Thread-safe.
class KeptProbe {
 public:
  /// `clock` outlives it, as does what `probe` uses.
  KeptProbe(std::function<absl::Status()> probe, const Clock& clock, ProbePatience patience = {});

  /// The answer. Unavailable: the probe has not come back yet, and since when.
  [[nodiscard]] absl::Status Ask();

 private:
  void Run(const std::stop_token& stop);

  std::function<absl::Status()> probe_;
  const Clock& clock_;
  ProbePatience patience_;
  std::mutex mutex_;
  std::condition_variable_any asked_;
  std::condition_variable answered_;
  std::optional<double> asked_s_{};  ///< the probe was sent out, and is not back
  absl::Status answer_;
  std::optional<double> answered_s_{};
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
