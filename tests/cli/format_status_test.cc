// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/format_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace orbweave {
namespace {

JobStatus Example() {
  return {.id = DigestOf("job"),
          .state = JobState::kFailed,
          .error = "stage align, part 0: \"no seam\"",
          .spec = {.label = "street"},
          .elapsed_s = 61.0,
          .stages = {{.stage = "align", .tasks_total = 1, .retries = 2}, {.stage = "merge"}},
          .workers = {{.name = "a", .tasks_done = 4, .set_aside = true, .draining = true},
                      {.name = "b", .alive = false}}};
}

TEST(FormatJobStatus, ShowsWhatWentWrongAndWhoIsThere) {
  const std::string text = FormatJobStatus(Example());
  EXPECT_THAT(text, ::testing::HasSubstr("failed  1 min 01 s  street"));
  EXPECT_THAT(text, ::testing::HasSubstr("no seam"));
  EXPECT_THAT(text, ::testing::HasSubstr("2 retries"));
  EXPECT_THAT(text, ::testing::HasSubstr("1 alive of 2"));
  EXPECT_THAT(text, ::testing::HasSubstr("set aside: a"));
  EXPECT_THAT(text, ::testing::HasSubstr("leaving: a"));
}

TEST(JobStatusToJson, NamesEverything) {
  const nlohmann::json job = nlohmann::json::parse(JobStatusToJson(Example()));
  EXPECT_EQ(job["id"], DigestOf("job").ToHex());
  EXPECT_EQ(job["state"], "failed");
  EXPECT_EQ(job["error"], Example().error);
  EXPECT_EQ(job["stages"].size(), 2U);
  EXPECT_EQ(job["stages"][0]["retries"], 2);
  EXPECT_EQ(job["workers"][1]["alive"], false);
  EXPECT_EQ(job["workers"][0]["set_aside"], true);
  EXPECT_EQ(job["workers"][0]["draining"], true);
}

}  // namespace
}  // namespace orbweave
