// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/event_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/command.h"

namespace orbweave {
namespace {

TEST(LogEventToJson, NamesWhatIsKnownAndNothingElse) {
  const LogEvent event{.level = LogLevel::kWarning,
                       .event = "task_not_done",
                       .job = DigestOf("job"),
                       .stage = "square",
                       .run = 2,
                       .part = 0,
                       .task = DigestOf("task"),
                       .worker = "w",
                       .slot = 0,
                       .epoch = 7,
                       .since_epoch = 5,
                       .traceparent = "00-trace",
                       .message = "two\nlines"};
  const nlohmann::json line = nlohmann::json::parse(LogEventToJson(event, 1.5));
  const nlohmann::json expected = {{"time", "1970-01-01T00:00:01.500Z"},
                                   {"level", "warning"},
                                   {"event", "task_not_done"},
                                   {"job", DigestOf("job").ToHex()},
                                   {"stage", "square"},
                                   {"run", 2},
                                   {"part", 0},
                                   {"task", DigestOf("task").ToHex()},
                                   {"worker", "w"},
                                   {"slot", 0},
                                   {"epoch", 7},
                                   {"since_epoch", 5},
                                   {"traceparent", "00-trace"},
                                   {"message", "two\nlines"}};
  EXPECT_EQ(line, expected);
  EXPECT_EQ(nlohmann::json::parse(LogEventToJson({.event = "ready"}, 0.0)).size(), 3U);
}

TEST(LogEventToJson, IsOneLineOfAsciiWhateverAWorkerSends) {
  const std::string hostile = "\n\r\x01\x1b[2J\x7f\xc2\x9b\"}{";
  const std::string line =
      LogEventToJson({.event = "e", .worker = hostile, .message = hostile + "\xff"}, 0.0);
  EXPECT_TRUE(std::ranges::all_of(line, [](char c) { return c >= 0x20 && c < 0x7f; })) << line;
  EXPECT_EQ(nlohmann::json::parse(line)["worker"], hostile);
}

TEST(OpenEventLog, AppendsToWhatIsThere) {
  const testing::TemporaryFolder folder;
  const std::string path = CoordinatorLogPath(folder / "state");
  for (const char* word : {"first", "second"}) {
    const absl::StatusOr<EventLog> log = OpenEventLog(path);
    ASSERT_TRUE(log.ok()) << log.status();
    (*log)({.event = word});
  }
  std::istringstream lines(testing::ReadAll(path));
  std::vector<std::string> events;
  for (std::string line; std::getline(lines, line);) {
    events.push_back(nlohmann::json::parse(line)["event"]);
  }
  EXPECT_THAT(events, ::testing::ElementsAre("first", "second"));
}

TEST(OpenEventLog, SaysWhenTheFileCannotBeOpened) {
  const testing::TemporaryFolder folder;
  testing::WriteAll(folder / "state", "a file");
  EXPECT_EQ(OpenEventLog(CoordinatorLogPath(folder / "state")).status().code(),
            absl::StatusCode::kPermissionDenied);
}

}  // namespace
}  // namespace orbweave
