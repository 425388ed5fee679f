// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// An event as one JSON object: the time (UTC; `time_s` is seconds since 1970), level, event, and
/// of the other fields those that are not empty.
[[nodiscard]] std::string LogEventToJson(const LogEvent& event, double time_s);

/// Writes an event to stderr as one line of JSON. Thread-safe.
void LogToStderr(const LogEvent& event);

/// A log that appends to `path`, line by line, and makes its folder where there is none. A line
/// that cannot be written is lost: a full disk does not stop the work. PermissionDenied: the file
/// cannot be opened.
[[nodiscard]] absl::StatusOr<EventLog> OpenEventLog(const std::string& path);

/// Where a coordinator whose state is in `state_dir` keeps its log.
[[nodiscard]] std::string CoordinatorLogPath(const std::string& state_dir);

}  // namespace orbweave
