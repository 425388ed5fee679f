// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/command.h"

namespace orbweave {
namespace {

using testing::TemporaryFolder;

TEST(Journal, RemembersResultsAcrossGenerations) {
  const TemporaryFolder folder;
  const Digest task = DigestOf("task");
  const TaskResult result{.outputs = {DigestOf("o")},
                          .recipes = {DigestOf("r")},
                          .report_json = "{}",
                          .cost = {.cpu_s = 1.5}};
  {
    auto journal = Journal::Open(folder.Path());
    ASSERT_TRUE(journal.ok());
    EXPECT_EQ(journal->generation(), 1U);
    EXPECT_TRUE(absl::IsNotFound(journal->LoadResult(task).status()));
    ASSERT_TRUE(journal->SaveResult(task, result).ok());
  }
  auto journal = Journal::Open(folder.Path());
  ASSERT_TRUE(journal.ok());
  EXPECT_EQ(journal->generation(), 2U);
  const auto loaded = journal->LoadResult(task);
  ASSERT_TRUE(loaded.ok());
  EXPECT_EQ(loaded->outputs, result.outputs);
  EXPECT_EQ(loaded->recipes, result.recipes);
  EXPECT_EQ(loaded->report_json, "{}");
  EXPECT_DOUBLE_EQ(loaded->cost.cpu_s, 1.5);
}

TEST(Journal, NoticesATornResult) {
  const TemporaryFolder folder;
  auto journal = Journal::Open(folder.Path());
  ASSERT_TRUE(journal.ok());
  const Digest task = DigestOf("task");
  ASSERT_TRUE(journal->SaveResult(task, {.outputs = {DigestOf("o")}}).ok());
  const std::string path = folder / ("results/" + task.ToHex());
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_TRUE(absl::IsDataLoss(journal->LoadResult(task).status()));
}

TEST(Journal, ListsJobsAsTheyWereSubmitted) {
  const TemporaryFolder folder;
  auto journal = Journal::Open(folder.Path());
  ASSERT_TRUE(journal.ok());
  for (uint64_t number = 5; number > 0; --number) {
    ASSERT_TRUE(
        journal->SaveJob({.spec = {.kind = "k" + std::to_string(number)}, .number = number}).ok());
  }
  ASSERT_TRUE(
      journal
          ->SaveJob(
              {.spec = {.kind = "k3"}, .state = JobState::kFailed, .error = "why", .number = 3})
          .ok());
  const auto jobs = journal->LoadJobs();
  ASSERT_TRUE(jobs.ok());
  ASSERT_EQ(jobs->size(), 5U);
  for (uint64_t i = 0; i < 5; ++i) EXPECT_EQ((*jobs)[i].spec.kind, "k" + std::to_string(i + 1));
  EXPECT_EQ((*jobs)[2].state, JobState::kFailed);
  EXPECT_EQ((*jobs)[2].error, "why");
}

}  // namespace
}  // namespace orbweave
