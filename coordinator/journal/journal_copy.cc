// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_copy.h"

#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <thread>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/forwarding_journal.h"
#include "coordinator/journal/sqlite_journal.h"
#include "core/base/digest.h"
#include "core/base/sleep.h"
#include "core/io/sqlite_connection.h"
#include "core/storage/durable_file.h"

namespace orbweave {
namespace {

namespace fs = std::filesystem;

struct FileSystem {
  uint32_t type;
  std::string_view name;
};

/// By the numbers of statfs(2).
constexpr std::array<FileSystem, 9> kShared = {{{0x6969, "NFS"},
                                                {0xFF534D42, "CIFS"},
                                                {0xFE534D42, "SMB"},
                                                {0x517B, "SMB"},
                                                {0x0BD00BD0, "Lustre"},
                                                {0x47504653, "GPFS"},
                                                {0x19830326, "BeeGFS"},
                                                {0x00C36400, "CephFS"},
                                                {0x5346414F, "AFS"}}};

/// Where a local journal notes which copy it is of: the digest of that file.
std::string MarkOf(const JournalPlace& place) { return place.local + ".copy"; }

/// Empty: there is no such file.
absl::StatusOr<std::string> HexOf(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::string();
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, DigestOfFile(path));
  return digest.ToHex();
}

/// Whether the copy is the one that the local journal made, or was made from, last.
absl::StatusOr<bool> IsOurs(const JournalPlace& place) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string copy, HexOf(place.copy));
  const absl::StatusOr<std::string> mark = ReadWholeFile(MarkOf(place));
  if (!mark.ok() && !absl::IsNotFound(mark.status())) return mark.status();
  return mark.value_or("") == copy;
}

absl::Status Mark(const JournalPlace& place) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string copy, HexOf(place.copy));
  const std::string folder = fs::path(place.local).parent_path().string();
  return WriteFileDurably(folder, MarkOf(place), copy);
}

/// Nobody takes the log of another file for that of the one that comes in its place.
absl::Status EndLog(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return absl::OkStatus();
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection journal, SqliteConnection::OpenToWrite(path));
  return journal.Execute("PRAGMA journal_mode = DELETE");
}

/// All that is committed in `from`; a crash leaves the old `to` or the whole new one.
absl::Status CopyJournal(const std::string& from, const std::string& to) {
  const std::string folder = fs::path(to).parent_path().string();
  const std::string fresh = ScratchPath(folder);
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection journal, SqliteConnection::OpenToWrite(from));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement copy, journal.Prepare("VACUUM INTO ?"));
  copy.Bind(1, std::string_view(fresh));
  absl::Status status = copy.Run();
  if (status.ok()) status = MoveFileDurably(fresh, to);
  std::error_code ignored;
  if (!status.ok()) fs::remove(fresh, ignored);
  return status;
}

/// A folder of this user's that nobody else may write, whoever may write the one above.
absl::Status MakePrivateFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(fs::path(path).parent_path(), error);
  struct stat info {};
  if (::mkdir(path.c_str(), S_IRWXU) != 0 && errno != EEXIST)
    return absl::ErrnoToStatus(errno, absl::StrCat("cannot make folder ", path));
  const bool is_ours = ::lstat(path.c_str(), &info) == 0 && S_ISDIR(info.st_mode) &&
                       info.st_uid == ::geteuid() && (info.st_mode & (S_IWGRP | S_IWOTH)) == 0;
  if (is_ours) return absl::OkStatus();
  return absl::PermissionDeniedError(absl::StrCat(
      path,
      " is not a folder that only we may write: remove it, or give another --journal-folder"));
}

void RemoveJournal(const std::string& path) {
  std::error_code ignored;
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(path + end, ignored);
}

/// A number that changes with every commit of others.
absl::StatusOr<int64_t> VersionOf(const SqliteConnection& journal) {
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement statement, journal.Prepare("PRAGMA data_version"));
  ORBWEAVE_RETURN_IF_ERROR(statement.Step().status());
  return statement.Integer(0);
}

/// Puts the copy in the place of a local journal that it was not made of.
absl::Status BringUpToDate(const JournalPlace& place) {
  ORBWEAVE_RETURN_IF_ERROR(EndLog(place.copy));
  std::error_code error;
  const bool has_copy = fs::exists(place.copy, error);
  ORBWEAVE_ASSIGN_OR_RETURN(const bool is_ours, IsOurs(place));
  if (!has_copy || !is_ours) RemoveJournal(place.local);
  if (has_copy && !fs::exists(place.local, error))
    ORBWEAVE_RETURN_IF_ERROR(CopyJournal(place.copy, place.local));
  return Mark(place);
}

class CopiedJournal final : public ForwardingJournal {
 public:
  CopiedJournal(std::unique_ptr<Journal> journal, JournalPlace place, CopyRule rule)
      : ForwardingJournal(std::move(journal)), place_(std::move(place)), rule_(std::move(rule)) {}
  ~CopiedJournal() override {
    thread_ = {};
    Copy().IgnoreError();
  }
  CopiedJournal(const CopiedJournal&) = delete;
  CopiedJournal& operator=(const CopiedJournal&) = delete;

  absl::Status Start() {
    ORBWEAVE_RETURN_IF_ERROR(Copy());
    ORBWEAVE_ASSIGN_OR_RETURN(SqliteConnection watched,
                              SqliteConnection::OpenToWrite(place_.local));
    thread_ = std::jthread([this, watched = std::move(watched)](const std::stop_token& stop) {
      KeepFresh(watched, stop);
    });
    return absl::OkStatus();
  }

  absl::Status Confirm() override {
    if (is_lost_) return TakenOver();
    return ForwardingJournal::Confirm();
  }

 private:
  [[nodiscard]] absl::Status TakenOver() const {
    return absl::FailedPreconditionError(
        absl::StrCat(place_.copy, " is of another coordinator, which has gone on from there"));
  }

  void KeepFresh(const SqliteConnection& watched, const std::stop_token& stop) {
    int64_t copied = 0;  // no version is
    while (!is_lost_ && SleepUnlessStopped(rule_.every_s, stop)) {
      const absl::StatusOr<int64_t> version = VersionOf(watched);
      if (version.ok() && *version == copied) continue;
      if (Copy().ok()) copied = version.value_or(copied);
    }
  }

  /// What went wrong was logged.
  absl::Status Copy() {
    const absl::Status status = TryToCopy();
    if (status.ok() || !rule_.log) return status;
    rule_.log({.level = is_lost_ ? LogLevel::kError : LogLevel::kWarning,
               .event = "journal_not_copied",
               .message = std::string(status.message())});
    return status;
  }

  absl::Status TryToCopy() {
    ORBWEAVE_ASSIGN_OR_RETURN(const bool is_ours, IsOurs(place_));
    is_lost_ = !is_ours;
    if (is_lost_) return TakenOver();
    ORBWEAVE_RETURN_IF_ERROR(CopyJournal(place_.local, place_.copy));
    return Mark(place_);
  }

  JournalPlace place_;
  CopyRule rule_;
  std::atomic<bool> is_lost_{false};
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace

std::string_view SharedFileSystemOf(const std::string& path) {
  struct statfs info {};
  if (::statfs(path.c_str(), &info) != 0) return {};
  const auto type = static_cast<uint32_t>(info.f_type);
  const auto* const found = std::ranges::find(kShared, type, &FileSystem::type);
  return found == kShared.end() ? std::string_view() : found->name;
}

JournalPlace PlaceJournal(const std::string& state_dir, const std::string& journal_folder) {
  std::error_code error;
  const std::string state = fs::absolute(state_dir, error).lexically_normal().string();
  return {.local = absl::StrCat(journal_folder,
                                "/orbweave-",
                                ::geteuid(),
                                "/journal-",
                                DigestOf(state).ToShortHex(),
                                ".db"),
          .copy = state_dir + "/journal.db"};
}

absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place,
                                                           CopyRule rule) {
  const std::string folder = fs::path(place.local).parent_path().string();
  ORBWEAVE_RETURN_IF_ERROR(MakePrivateFolder(folder));
  if (const std::string_view shared = SharedFileSystemOf(folder); !shared.empty()) {
    return absl::FailedPreconditionError(absl::StrCat(
        folder, " is on ", std::string(shared), ": the journal needs a disk of this machine"));
  }
  ORBWEAVE_RETURN_IF_ERROR(BringUpToDate(place));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<Journal> local, OpenSqliteJournal(place.local));
  auto journal = std::make_unique<CopiedJournal>(std::move(local), place, std::move(rule));
  ORBWEAVE_RETURN_IF_ERROR(journal->Start());
  return journal;
}

absl::StatusOr<std::unique_ptr<Journal>> OpenJournalToLook(const std::string& state_dir) {
  std::error_code error;
  std::string folder = (fs::temp_directory_path(error) / "orbweave-look-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr)
    return absl::ErrnoToStatus(errno, absl::StrCat("cannot make a folder like ", folder));
  const JournalPlace place{folder + "/journal.db", state_dir + "/journal.db"};
  absl::Status copied =
      fs::exists(place.copy, error) ? CopyJournal(place.copy, place.local) : absl::OkStatus();
  absl::StatusOr<std::unique_ptr<Journal>> journal =
      copied.ok() ? OpenSqliteJournal(place.local) : copied;
  fs::remove_all(folder, error);  // what is open stays until it is closed
  return journal;
}

}  // namespace orbweave
