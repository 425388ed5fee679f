// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/progress/format_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace orbweave {
namespace {

JobStatus Example() {
  return {.id = DigestOf("job"),
          .state = JobState::kFailed,
          .error = "stage align, part 0: \"no seam\"",
          .spec = {.label = "street"},
          .elapsed_s = 61.0,
          .stages = {{.stage = "align", .tasks_total = 1, .retries = 2}, {.stage = "merge"}}};
}

std::vector<WorkerStatus> Workers() {
  return {{.name = "a", .tasks_done = 4, .set_aside = true, .draining = true},
          {.name = "b", .alive = false}};
}

TEST(FormatJobStatus, ShowsWhatWentWrongAndWhoIsThere) {
  const std::string text = FormatJobStatus(Example());
  EXPECT_THAT(text, ::testing::HasSubstr("failed       0 %  1 min 01 s  street\n"));
  EXPECT_THAT(text, ::testing::HasSubstr("no seam"));
  EXPECT_THAT(text, ::testing::ContainsRegex("align +0/1 +0 +0 +2 "));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("merge"))) << "nothing is known of it";
}

TEST(FormatJobStatus, SaysHowLongARunningJobMayTake) {
  JobStatus job = Example();
  job.state = JobState::kRunning;
  job.stages = {{.stage = "align", .tasks_total = 2, .tasks_done = 1, .busy_s = 61.0}};
  EXPECT_THAT(FormatJobLine(job), ::testing::HasSubstr(" 50 %  1 min 01 s  about 1 min 01 s left"));
  EXPECT_EQ(nlohmann::json::parse(JobStatusToJson(job))["eta_s"], 61.0);
}

TEST(FormatJobStatus, SaysWhatNoWorkerHas) {
  JobStatus job = Example();
  EXPECT_THAT(FormatJobStatus(job), ::testing::Not(::testing::HasSubstr("waits")));
  job.state = JobState::kRunning;
  job.unmet = "a task of stage align asks for 1 GPU (no worker has any)";
  EXPECT_THAT(FormatJobStatus(job), ::testing::HasSubstr("  waits: " + job.unmet + "\n"));
  EXPECT_EQ(nlohmann::json::parse(JobStatusToJson(job))["unmet"], job.unmet);
}

TEST(FormatWorkers, SaysWhoIsThereAndWhoGetsNoMore) {
  const std::string text =
      FormatWorkers({{.name = "a", .tasks_done = 4},
                     {.name = "b", .alive = false},
                     {.name = "c", .slots = 3, .draining = true, .tasks_running = 2},
                     {.name = "d", .set_aside = true}});
  EXPECT_THAT(text, ::testing::ContainsRegex("a +4 +1 +0  at work\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("b +0 +1 +0  gone\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("c +0 +3 +2  draining\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("d +0 +1 +0  set aside"));
}

/// Clears a terminal, goes back to the start of the line, begins another one.
constexpr const char* kHostile = "\x1b[2J\r\nworker fake\x7f\xc2\x9b";

TEST(FormatJobStatus, ShowsStrangersTextWithoutObeyingIt) {
  JobStatus job = Example();
  job.spec.label = kHostile;
  job.stages[0].stage = kHostile;
  std::vector<WorkerStatus> workers = Workers();
  workers[0].name = kHostile;
  const std::string text = FormatJobStatus(job) + FormatWorkers(workers);
  EXPECT_EQ(text.find_first_of("\x1b\r\x7f\x9b"), std::string::npos) << text;
  EXPECT_EQ(std::ranges::count(text, '\n'),
            std::ranges::count(FormatJobStatus(Example()) + FormatWorkers(Workers()), '\n'));
}

TEST(JobStatusToJson, IsOneLineOfAsciiWhateverStrangersWrite) {
  JobStatus job = Example();
  job.spec.label = std::string(kHostile) + "\xff";
  std::vector<WorkerStatus> workers = Workers();
  workers[0].name = kHostile;
  for (const std::string& json : {JobStatusToJson(job), WorkersToJson(workers)}) {
    EXPECT_TRUE(std::ranges::all_of(json, [](char c) { return c >= 0x20 && c < 0x7f; })) << json;
    EXPECT_TRUE(nlohmann::json::accept(json)) << json;
  }
  EXPECT_EQ(nlohmann::json::parse(WorkersToJson(workers))["workers"][0]["name"], kHostile);
}

TEST(JobStatusToJson, NamesEverything) {
  const nlohmann::json job = nlohmann::json::parse(JobStatusToJson(Example()));
  EXPECT_EQ(job["id"], DigestOf("job").ToHex());
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["error"], Example().error);
  EXPECT_TRUE(job["eta_s"].is_null()) << "nothing to go by";
  EXPECT_EQ(job["stages"].size(), 2U);
  EXPECT_EQ(job["stages"][0]["retries"], 2);
}

TEST(WorkersToJson, NamesEverythingAlsoWhenNobodyIsThere) {
  const nlohmann::json workers = nlohmann::json::parse(WorkersToJson(Workers()))["workers"];
  EXPECT_EQ(workers[0]["set_aside"], true);
  EXPECT_EQ(workers[0]["draining"], true);
  EXPECT_EQ(workers[1]["name"], "b");
  EXPECT_EQ(workers[1]["alive"], false);
  EXPECT_EQ(WorkersToJson({}), R"({"workers":[]})");
  EXPECT_EQ(FormatWorkers({}), "no workers\n");
}

}  // namespace
}  // namespace orbweave
