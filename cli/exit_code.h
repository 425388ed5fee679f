// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/status.h"

namespace orbweave {

/// What `orbweave` returns to the shell.
enum ExitCode : int {
  kExitOk = 0,
  kExitFailed = 1,        ///< the job failed, or something broke on the way
  kExitUsage = 2,         ///< the command line or the input is not right
  kExitUnavailable = 3,   ///< no coordinator there
  kExitInterrupted = 130  ///< stopped by Ctrl-C or SIGTERM
};

[[nodiscard]] int ExitCodeOf(const absl::Status& status);

/// Prints "orbweave: <message>" to stderr unless OK; returns the exit code.
int ReportStatus(const absl::Status& status);

}  // namespace orbweave
