// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_copy.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "coordinator/journal/sqlite_journal.h"
#include "core/io/sqlite_connection.h"
#include "tests/support/command.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

/// A state folder that two machines see, each with a disk of its own.
class JournalCopyTest : public ::testing::Test {
 protected:
  JournalCopyTest() { fs::create_directory(folder_ / "state"); }

  JournalPlace On(const std::string& machine) {
    return PlaceJournal(folder_ / "state", folder_ / machine);
  }
  static void Save(Journal& journal, uint64_t number) {
    const Digest task = DigestOf(std::to_string(number));
    EXPECT_TRUE(journal.SaveResult(number, task, {.report_json = "done"}).ok());
  }
  static bool Knows(Journal& journal, uint64_t number) {
    const auto found = journal.LoadResults({DigestOf(std::to_string(number))});
    return found.ok() && found->at(0).has_value();
  }
  std::vector<std::string> FilesIn(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / folder))
      names.push_back(entry.path().filename().string());
    return names;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(JournalCopyTest, AnotherMachineGoesOnWhereTheFirstEnded) {
  uint64_t generation = 0;
  {
    const auto journal = *OpenCopiedJournal(On("a"));
    generation = journal->generation();
    Save(*journal, 1);
  }
  const auto journal = *OpenCopiedJournal(On("b"));
  EXPECT_TRUE(Knows(*journal, 1));
  EXPECT_GT(journal->generation(), generation);
}

TEST_F(JournalCopyTest, WhatWasNewerThanTheCopyOfALostMachineIsForgotten) {
  const auto lost = *OpenCopiedJournal(On("a"), {.every_s = 1e6});
  Save(*lost, 1);
  const auto journal = *OpenCopiedJournal(On("b"));
  EXPECT_FALSE(Knows(*journal, 1));
  EXPECT_GT(journal->generation(), lost->generation())
      << "nobody takes a lease of the one for a lease of the other";
}

TEST_F(JournalCopyTest, IsMadeWhileTheJournalIsWritten) {
  const auto journal = *OpenCopiedJournal(On("a"), {.every_s = 0.05});
  Save(*journal, 1);
  const auto is_copied = [&] {  // without beginning a generation in it
    const auto other = SqliteConnection::OpenToWrite(folder_ / "state/journal.db");
    auto results = other->Prepare("SELECT 1 FROM orbweave_result");
    return results.ok() && *results->Step();
  };
  EXPECT_TRUE(testing::WaitUntil(is_copied, 20.0));
}

TEST_F(JournalCopyTest, TheSameMachineKeepsWhatItHas) {
  const JournalPlace place = On("a");
  const std::vector<std::string> files = {place.copy, place.local + ".copy"};
  {
    const auto journal = *OpenCopiedJournal(place, {.every_s = 1e6});
    Save(*journal, 1);
    for (const std::string& file : files) fs::copy_file(file, file + ".killed");
  }
  for (const std::string& file : files) fs::rename(file + ".killed", file);  // before the last copy
  EXPECT_TRUE(Knows(**OpenCopiedJournal(place), 1));
}

TEST_F(JournalCopyTest, AMachineThatHadItBeforeTakesWhatAnotherDidMeanwhile) {
  for (const char* machine : {"a", "b"}) {
    const auto journal = *OpenCopiedJournal(On(machine));
    Save(*journal, machine[0] == 'a' ? 1 : 2);
  }
  const auto journal = *OpenCopiedJournal(On("a"));
  EXPECT_TRUE(Knows(*journal, 1));
  EXPECT_TRUE(Knows(*journal, 2));
}

TEST_F(JournalCopyTest, OneThatWasCutOffDoesNotUndoWhatAnotherDid) {
  auto cut_off = *OpenCopiedJournal(On("a"), {.every_s = 1e6});
  {
    const auto journal = *OpenCopiedJournal(On("b"));
    Save(*journal, 2);
  }
  Save(*cut_off, 1);
  cut_off.reset();
  EXPECT_TRUE(Knows(**OpenCopiedJournal(On("c")), 2));
}

TEST_F(JournalCopyTest, OneThatBeganAndMadeNoCopyDoesNotUndoWhatAnotherDid) {
  { (void)*OpenCopiedJournal(On("a")); }
  fs::remove(On("a").copy);  // killed before its first copy
  {
    const auto journal = *OpenCopiedJournal(On("b"));
    Save(*journal, 2);
  }
  EXPECT_TRUE(Knows(**OpenCopiedJournal(On("a")), 2));
}

TEST_F(JournalCopyTest, OneThatWasCutOffLearnsOfIt) {
  const auto cut_off = *OpenCopiedJournal(On("a"), {.every_s = 0.05});
  EXPECT_TRUE(cut_off->Confirm().ok());
  // The other may begin just when a copy is made, and is then the one that is cut off.
  EXPECT_TRUE(testing::WaitUntil([&] { return OpenCopiedJournal(On("b")).ok(); }, 20.0));
  Save(*cut_off, 1);
  const auto is_lost = [&] { return absl::IsFailedPrecondition(cut_off->Confirm()); };
  EXPECT_TRUE(testing::WaitUntil(is_lost, 20.0));
}

TEST_F(JournalCopyTest, OfAStateThatWasRemovedIsNotUsedForTheNext) {
  {
    const auto journal = *OpenCopiedJournal(On("a"));
    Save(*journal, 1);
  }
  fs::remove_all(folder_ / "state");
  fs::create_directory(folder_ / "state");
  EXPECT_FALSE(Knows(**OpenCopiedJournal(On("a")), 1));
}

TEST_F(JournalCopyTest, IsNotKeptWhereOthersMayWrite) {
  const std::string folder = fs::path(On("a").local).parent_path().string();
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::all);
  EXPECT_TRUE(absl::IsPermissionDenied(OpenCopiedJournal(On("a")).status()));
  fs::remove_all(folder);
  fs::create_directory_symlink(folder_ / "state", folder);
  EXPECT_TRUE(absl::IsPermissionDenied(OpenCopiedJournal(On("a")).status()));
}

TEST_F(JournalCopyTest, IsLookedAtWithoutAChange) {
  {
    const auto journal = *OpenCopiedJournal(On("a"));
    Save(*journal, 1);
  }
  const std::string before = testing::ReadAll(folder_ / "state/journal.db");
  EXPECT_TRUE(Knows(**OpenJournalToLook(folder_ / "state"), 1));
  EXPECT_EQ(testing::ReadAll(folder_ / "state/journal.db"), before);
}

TEST_F(JournalCopyTest, TakesOverAJournalThatWasInTheStateFolderItself) {
  { Save(**OpenSqliteJournal(folder_ / "state/journal.db"), 1); }
  const auto journal = *OpenCopiedJournal(On("a"));
  EXPECT_TRUE(Knows(*journal, 1));
  EXPECT_EQ(FilesIn("state"), std::vector<std::string>{"journal.db"}) << "and no log of it";
}

TEST(SharedFileSystem, IsNotThatOfThisMachinesDisks) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(SharedFileSystemOf(folder.Path()), "");
  EXPECT_EQ(SharedFileSystemOf("/no/such/folder"), "");
}

}  // namespace
}  // namespace orbweave
