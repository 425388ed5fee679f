// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/sqlite_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

TEST_F(SqliteJournal, AResultWhoseBytesWereChangedCountsAsNone) {
  FillJournal();
  const auto database = SqliteConnection::OpenToWrite(path_);
  ASSERT_TRUE(database->Execute("UPDATE orbweave_result SET content = x'0a' || content").ok());
  auto journal = OpenSqliteJournal(path_);
  ASSERT_TRUE(journal.ok()) << journal.status();
  EXPECT_FALSE((*journal)->LoadResults({kTask})->at(0).has_value());
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
