// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/event_log.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace orbweave {
namespace {

/// "2026-05-01T09:30:00.125Z".
std::string FormatTime(double time_s) {
  const auto time_ms = static_cast<int64_t>(std::llround(time_s * 1e3));
  const auto whole = static_cast<std::time_t>(time_ms / 1000);
  std::tm utc{};
  ::gmtime_r(&whole, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  return absl::StrFormat("%s.%03dZ", text.data(), time_ms % 1000);
}

void WriteLine(std::FILE* file, const LogEvent& event) {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::string line = LogEventToJson(event, std::chrono::duration<double>(now).count()) + "\n";
  std::fwrite(line.data(), 1, line.size(), file);
  std::fflush(file);
}

}  // namespace

std::string LogEventToJson(const LogEvent& event, double time_s) {
  nlohmann::ordered_json line = {
      {"time", FormatTime(time_s)}, {"level", LogLevelName(event.level)}, {"event", event.event}};
  if (!event.job.IsZero()) line["job"] = event.job.ToHex();
  if (!event.stage.empty()) line["stage"] = event.stage;
  if (event.run) line["run"] = *event.run;
  if (event.part) line["part"] = *event.part;
  if (!event.task.IsZero()) line["task"] = event.task.ToHex();
  if (!event.worker.empty()) line["worker"] = event.worker;
  if (event.slot) line["slot"] = *event.slot;
  if (event.epoch != 0) line["epoch"] = event.epoch;
  if (event.since_epoch) line["since_epoch"] = *event.since_epoch;
  if (!event.traceparent.empty()) line["traceparent"] = event.traceparent;
  if (!event.message.empty()) line["message"] = event.message;
  return line.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

void LogToStderr(const LogEvent& event) { WriteLine(stderr, event); }

absl::StatusOr<EventLog> OpenEventLog(const std::string& path) {
  std::error_code ignored;  // what stands in the way is said when the file is opened
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  std::FILE* opened = std::fopen(path.c_str(), "ae");
  if (opened == nullptr) {
    return absl::PermissionDeniedError(
        absl::StrCat("cannot write the log ", path, ": ", std::strerror(errno)));
  }
  const std::shared_ptr<std::FILE> file(opened, [](std::FILE* open) { std::fclose(open); });
  return [file](const LogEvent& event) { WriteLine(file.get(), event); };
}

std::string CoordinatorLogPath(const std::string& state_dir) {
  return state_dir + "/logs/coordinator.log";
}

}  // namespace orbweave
