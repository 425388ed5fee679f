// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/open_journal.h"

#include <filesystem>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/journal_copy.h"
#include "coordinator/journal/sqlite_journal.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

absl::Status RefuseFolderOfFiles(const std::string& state_dir) {
  std::error_code ignored;
  if (!std::filesystem::exists(state_dir + "/generation", ignored)) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat("the folder ",
                   state_dir,
                   " was written by an older version of orbweave, which kept its results in files; "
                   "choose another folder, or remove it and compute everything again"));
}

}  // namespace

absl::StatusOr<std::unique_ptr<Journal>> OpenJournal(const std::string& state_dir) {
  ORBWEAVE_RETURN_IF_ERROR(RefuseFolderOfFiles(state_dir));
  if (const std::string_view shared = SharedFileSystemOf(state_dir); !shared.empty()) {
    return absl::FailedPreconditionError(absl::StrCat(
        state_dir,
        " is on ",
        std::string(shared),
        ", where a journal gets damaged: give --journal-folder with a folder on a disk "
        "of this machine, or --journal with a PostgreSQL database"));
  }
  return OpenSqliteJournal(state_dir + "/journal.db");
}

absl::StatusOr<std::unique_ptr<Journal>> OpenJournalIn(const std::string& journal_folder,
                                                       const std::string& state_dir,
                                                       const EventLog& log) {
  if (journal_folder.empty()) return OpenJournal(state_dir);
  return OpenCopiedJournal(PlaceJournal(state_dir, journal_folder), {.log = log});
}

}  // namespace orbweave
