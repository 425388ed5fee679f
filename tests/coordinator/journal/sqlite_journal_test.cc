// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/sqlite_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <random>
#include <thread>

#include "core/io/sqlite_connection.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

using ::testing::HasSubstr;
using testing::TemporaryFolder;

const Digest kTask = DigestOf("task");

class SqliteJournal : public ::testing::Test {
 protected:
  void FillJournal() const {
    auto journal = OpenSqliteJournal(path_);
    ASSERT_TRUE(journal.ok()) << journal.status();
    for (uint64_t i = 0; i < 200; ++i) {
      const Digest task = DigestOf("task" + std::to_string(i));
      ASSERT_TRUE((*journal)->SaveResult(i, task, {.report_json = std::string(200, 'x')}).ok());
    }
    ASSERT_TRUE((*journal)->SaveResult(200, kTask, {.report_json = "precious"}).ok());
  }

  void ExpectDamaged() const {
    const auto journal = OpenSqliteJournal(path_);
    EXPECT_TRUE(absl::IsDataLoss(journal.status())) << journal.status();
    EXPECT_THAT(std::string(journal.status().message()), HasSubstr(path_));
    EXPECT_THAT(std::string(journal.status().message()), HasSubstr("submit its jobs again"));
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "journal.db";
};

TEST_F(SqliteJournal, SaysThatAFileIsNoJournalAndWhatToDo) {
  std::ofstream(path_) << std::string(5000, 'z');
  ExpectDamaged();
}

// As whoever looks into the journal of a killed coordinator does, to put it in order.
TEST_F(SqliteJournal, WaitsForOneWhoHasTheFileToItself) {
  FillJournal();
  std::optional<SqliteConnection> other = SqliteConnection::OpenToWrite(path_).value();
  ASSERT_TRUE(other->Execute("PRAGMA locking_mode = EXCLUSIVE; BEGIN EXCLUSIVE; COMMIT").ok());
  std::thread leaves([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    other.reset();
  });
  const auto journal = OpenSqliteJournal(path_);
  leaves.join();
  EXPECT_TRUE(journal.ok()) << journal.status();
}

TEST_F(SqliteJournal, NoticesDamageInsideTheFile) {
  FillJournal();
  std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
  for (std::streamoff page = 6; page < 12; ++page) {
    file.seekp(page * 4096);
    file << std::string(64, '\xff');
  }
  file.close();
  ExpectDamaged();
}

TEST_F(SqliteJournal, NoticesACutFile) {
  FillJournal();
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  ExpectDamaged();
}

/// The files of a journal that is open, as a machine that loses power leaves them.
class DamagedLog : public SqliteJournal {
 protected:
  static constexpr uint64_t kResults = 60;

  static Digest TaskOf(uint64_t i) { return DigestOf("task" + std::to_string(i)); }
  static std::string ReportOf(uint64_t i) { return std::to_string(i) + std::string(700, 'x'); }

  void SetUp() override {
    auto journal = OpenSqliteJournal(path_);
    ASSERT_TRUE(journal.ok()) << journal.status();
    for (uint64_t i = 0; i < kResults; ++i)
      ASSERT_TRUE((*journal)->SaveResult(i, TaskOf(i), {.report_json = ReportOf(i)}).ok());
    database_ = testing::ReadAll(path_);
    log_ = testing::ReadAll(path_ + "-wal");
    ASSERT_GT(log_.size(), 100'000U) << "all is in the log still";
  }

  /// Opens a copy with this log: how many results it has, each as it was saved, the first ones
  /// without a gap; nothing when it is refused, which says what to do.
  std::optional<uint64_t> ResultsWith(const std::string& log) {
    const TemporaryFolder folder;
    const std::string path = folder / "journal.db";
    testing::WriteAll(path, database_);
    testing::WriteAll(path + "-wal", log);
    auto journal = OpenSqliteJournal(path);
    if (!journal.ok()) {
      EXPECT_TRUE(absl::IsDataLoss(journal.status())) << journal.status();
      EXPECT_THAT(std::string(journal.status().message()), HasSubstr(path));
      return std::nullopt;
    }
    std::vector<Digest> tasks;
    for (uint64_t i = 0; i < kResults; ++i) tasks.push_back(TaskOf(i));
    const auto results = (*journal)->LoadResults(tasks);
    EXPECT_TRUE(results.ok()) << results.status();
    uint64_t known = 0;
    bool has_gap = false;
    for (uint64_t i = 0; results.ok() && i < kResults; ++i) {
      if (!results->at(i)) {
        has_gap = true;
        continue;
      }
      EXPECT_FALSE(has_gap) << "result " << i << " outlived one that was saved before it";
      EXPECT_EQ(results->at(i)->report_json, ReportOf(i));
      ++known;
    }
    return known;
  }

  std::string database_;
  std::string log_;
};

TEST_F(DamagedLog, LosesWhatCameAfterTheDamageAndInventsNothing) {
  EXPECT_EQ(ResultsWith(log_), kResults);
  std::mt19937 random(17);
  uint64_t lost_some = 0;
  for (int trial = 0; trial < 150; ++trial) {
    std::string log = log_;
    const size_t where = random() % log.size();
    const size_t length = std::min<size_t>(log.size() - where, 1 + random() % 64);
    for (size_t i = 0; i < length; ++i) log[where + i] = static_cast<char>(random());
    if (ResultsWith(log).value_or(0) < kResults) ++lost_some;
  }
  EXPECT_GT(lost_some, 100U) << "damage was where it matters";
}

TEST_F(DamagedLog, OneThatIsCutLosesItsEnd) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 50; ++trial) {
    const size_t size = random() % log_.size();
    EXPECT_TRUE(ResultsWith(log_.substr(0, size)).has_value());
  }
  EXPECT_EQ(ResultsWith(""), 0U);
}

TEST_F(SqliteJournal, AResultWhoseBytesWereChangedCountsAsNone) {
  FillJournal();
  const auto database = SqliteConnection::OpenToWrite(path_);
  ASSERT_TRUE(database->Execute("UPDATE orbweave_result SET content = x'0a' || content").ok());
  auto journal = OpenSqliteJournal(path_);
  ASSERT_TRUE(journal.ok()) << journal.status();
  EXPECT_FALSE((*journal)->LoadResults({kTask})->at(0).has_value());
}

TEST_F(SqliteJournal, TakesUpAJournalOfTheFormatBefore) {
  {
    const auto database = SqliteConnection::OpenToWrite(path_);
    for (const char* statement :
         {"CREATE TABLE orbweave (format BIGINT NOT NULL, generation BIGINT NOT NULL)",
          "INSERT INTO orbweave VALUES (1, 4)",
          "CREATE TABLE orbweave_job (id BYTEA PRIMARY KEY, number BIGINT NOT NULL, "
          "state BIGINT NOT NULL, error TEXT NOT NULL, spec BYTEA NOT NULL)",
          "INSERT INTO orbweave_job VALUES (x'01', 1, 0, '', x'')",
          "CREATE TABLE orbweave_attempt (epoch BIGINT PRIMARY KEY, task BYTEA NOT NULL, "
          "job BYTEA NOT NULL, stage TEXT NOT NULL, part BIGINT NOT NULL, worker TEXT NOT NULL, "
          "slot BIGINT NOT NULL, started_s DOUBLE PRECISION NOT NULL, ended_s DOUBLE PRECISION, "
          "reason TEXT)"})
      ASSERT_TRUE(database->Execute(statement).ok()) << statement;
  }
  for (uint64_t generation = 5; generation < 7; ++generation) {
    auto journal = OpenSqliteJournal(path_);
    ASSERT_TRUE(journal.ok()) << journal.status();
    EXPECT_EQ((*journal)->generation(), generation);
    EXPECT_EQ((*journal)->LoadJobs()->size(), 1U);
    EXPECT_TRUE((*journal)->LoadFailures(JobSpec{}.Id(), 0)->empty());
    EXPECT_TRUE((*journal)->SaveResult(generation, kTask, {.report_json = "precious"}).ok());
  }
}

TEST_F(SqliteJournal, RefusesAnotherFormat) {
  FillJournal();
  const auto database = SqliteConnection::OpenToWrite(path_);
  ASSERT_TRUE(database->Execute("UPDATE orbweave SET format = 99").ok());
  const auto journal = OpenSqliteJournal(path_);
  EXPECT_TRUE(absl::IsFailedPrecondition(journal.status()));
  EXPECT_THAT(std::string(journal.status().message()), HasSubstr("format 99"));
}

}  // namespace
}  // namespace orbweave
