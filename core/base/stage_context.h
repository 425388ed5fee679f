// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

#include "core/base/status.h"

namespace orbweave {

/// What a stage has done so far: "registered 17 of 90 images".
struct Progress {
  uint64_t done = 0;
  uint64_t total = 0;
  std::string unit{};
};

/// Everything a stage may reach outside its input: a wish to stop, ears for progress and for signs
/// of life, a number of threads and a seed. No clock, no files, no logger.
struct StageContext {
  std::stop_token stop{};
  std::function<void(const Progress&)> report{};
  std::function<void()> alive{};  ///< called by each CheckStop, from any thread
  int num_threads = 1;
  uint64_t seed = 0;

  /// Cancelled once somebody asked to stop; polled per RANSAC round, image and solver step. Also
  /// the sign that the work goes on: whoever does not call for minutes of processor time is taken
  /// to spin.
  [[nodiscard]] absl::Status CheckStop() const {
    if (alive) alive();
    return stop.stop_requested() ? absl::CancelledError("stopped on request") : absl::OkStatus();
  }
  void Report(uint64_t done, uint64_t total, const char* unit) const {
    if (report) report({done, total, unit});
  }
};

}  // namespace orbweave
