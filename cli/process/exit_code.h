// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// What `orbweave` returns to the shell.
enum ExitCode : int {
  kExitOk = 0,
  kExitFailed = 1,        ///< the job failed or registered nothing, or something broke on the way
  kExitUsage = 2,         ///< the command line or the input is not right
  kExitUnavailable = 3,   ///< no coordinator there
  kExitVerdict = 4,       ///< the job is done, its model judged as --fail-on does not take it
  kExitStopped = 75,      ///< a worker was told to end, or its time was up: there may be more to do
  kExitInterrupted = 130  ///< stopped by Ctrl-C or SIGTERM
};

/// The error of a job that is done and whose verdict is too bad: its exit code is kExitVerdict.
[[nodiscard]] absl::Status VerdictError(const std::string& message);

/// Of a worker that left though there may be more to do: its exit code is kExitStopped.
[[nodiscard]] absl::Status StoppedError(const std::string& message);

[[nodiscard]] int ExitCodeOf(const absl::Status& status);

/// Prints "orbweave: <message>" to stderr unless OK; returns the exit code.
int ReportStatus(const absl::Status& status);

}  // namespace orbweave
