// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/base/digest.h"

namespace orbweave {

enum class LogLevel : uint8_t {
  kInfo,
  kWarning,  ///< something failed and is tried again
  kError     ///< somebody has to look
};

/// "info", "warning" or "error".
[[nodiscard]] const char* LogLevelName(LogLevel level);

/// One thing that happened in a coordinator or a worker. What does not apply is left empty. Secrets
/// and the bytes of blobs never get here.
struct LogEvent {
  LogLevel level = LogLevel::kInfo;
  std::string event{};  ///< what happened, in one word: "task_done"
  Digest job{};
  std::string stage{};
  std::optional<uint32_t> run{};  ///< of the job's stages, as in MeasuredTask
  std::optional<uint32_t> part{};
  Digest task{};
  std::string worker{};
  std::optional<uint32_t> slot{};
  uint64_t epoch = 0;                     ///< of the attempt at the task
  std::optional<uint64_t> since_epoch{};  ///< of a job that begins: later attempts are made for it
  std::string traceparent{};              ///< of a job that begins; see JobSpec
  std::string message{};
};

/// Told each event as it happens, from several threads; must be quick. May be empty.
using EventLog = std::function<void(const LogEvent& event)>;

}  // namespace orbweave
