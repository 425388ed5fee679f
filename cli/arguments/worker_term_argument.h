// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "core/base/status.h"
#include "worker/worker_loop.h"

namespace orbweave {

/// When a worker is to end of itself, as the command line says it.
struct WorkerTermArgument {
  WorkerTerm term{};
  std::string until{};  ///< a time of day; see ParseUnixTime

  /// The term of a worker that starts at `now_unix_s`; its lifetime is up to a tenth shorter, each
  /// time another, so that workers that were started together do not end together.
  /// InvalidArgument: `until` is no time, or is over.
  [[nodiscard]] absl::StatusOr<WorkerTerm> Begin(int64_t now_unix_s) const;
};

/// Declares `--idle-exit`, `--patience`, `--lifetime` and `--until`.
void AddWorkerTermArguments(CLI::App& command, WorkerTermArgument& argument);

/// Seconds since 1970 of "1795452000", of "2026-11-23T18:00:00" in this machine's time zone, or of
/// "2026-11-23T18:00:00Z". InvalidArgument: anything else.
[[nodiscard]] absl::StatusOr<int64_t> ParseUnixTime(const std::string& text);

}  // namespace orbweave
