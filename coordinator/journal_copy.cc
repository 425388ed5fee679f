// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal_copy.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/sqlite_journal.h"
#include "core/base/digest.h"
#include "core/base/file_descriptor.h"
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

absl::Status Sync(const std::string& path, int kind) {
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | kind));
  if (file.IsOpen() && ::fsync(file.get()) == 0) return absl::OkStatus();
  return absl::ErrnoToStatus(errno, absl::StrCat("cannot sync ", path));
}

/// All that is committed in `from`; a crash leaves the old `to` or the whole new one.
absl::Status CopyJournal(const std::string& from, const std::string& to) {
  const std::string folder = fs::path(to).parent_path().string();
  const std::string fresh = ScratchPath(folder);
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection journal, SqliteConnection::OpenToWrite(from));
  ORBWEAVE_RETURN_IF_ERROR(journal.Execute("PRAGMA busy_timeout = 10000"));
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement copy, journal.Prepare("VACUUM INTO ?"));
  copy.Bind(1, std::string_view(fresh));
  absl::Status status = copy.Run();
  if (status.ok()) status = Sync(fresh, 0);
  std::error_code error;
  if (status.ok()) fs::rename(fresh, to, error);
  if (error)
    status = absl::UnavailableError(absl::StrCat("cannot write ", to, ": ", error.message()));
  if (status.ok()) return Sync(folder, O_DIRECTORY);
  fs::remove(fresh, error);
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

absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place) {
  const std::string folder = fs::path(place.local).parent_path().string();
  ORBWEAVE_RETURN_IF_ERROR(MakePrivateFolder(folder));
  if (const std::string_view shared = SharedFileSystemOf(folder); !shared.empty()) {
    return absl::FailedPreconditionError(absl::StrCat(
        folder, " is on ", std::string(shared), ": the journal needs a disk of this machine"));
  }
  ORBWEAVE_RETURN_IF_ERROR(EndLog(place.copy));
  std::error_code error;
  const bool has_copy = fs::exists(place.copy, error);
  ORBWEAVE_ASSIGN_OR_RETURN(const bool is_ours, IsOurs(place));
  if (!has_copy || !is_ours) RemoveJournal(place.local);
  if (has_copy && !fs::exists(place.local, error))
    ORBWEAVE_RETURN_IF_ERROR(CopyJournal(place.copy, place.local));
  ORBWEAVE_RETURN_IF_ERROR(Mark(place));
  return OpenSqliteJournal(place.local);
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

absl::StatusOr<std::unique_ptr<JournalCopy>> JournalCopy::Start(const JournalPlace& place,
                                                                JournalCopyOptions options) {
  std::unique_ptr<JournalCopy> copy(new JournalCopy(place, std::move(options)));
  ORBWEAVE_RETURN_IF_ERROR(copy->CopyOrTell());
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteConnection watched, SqliteConnection::OpenToWrite(place.local));
  copy->thread_ =
      std::jthread([raw = copy.get(), watched = std::move(watched)](const std::stop_token& stop) {
        int64_t copied = 0;  // no version is
        while (SleepUnlessStopped(raw->options_.every_s, stop)) {
          const absl::StatusOr<int64_t> version = VersionOf(watched);
          if (version.ok() && *version == copied) continue;
          const absl::Status status = raw->CopyOrTell();
          if (status.ok()) copied = version.value_or(copied);
          if (!absl::IsAborted(status)) continue;
          if (raw->options_.lost) raw->options_.lost(status);
          return;
        }
      });
  return copy;
}

JournalCopy::~JournalCopy() {
  thread_ = {};
  CopyOrTell().IgnoreError();
}

absl::Status JournalCopy::CopyOrTell() const {
  absl::StatusOr<bool> is_ours = IsOurs(place_);
  absl::Status status = is_ours.status();
  if (is_ours.ok() && !*is_ours) {
    status = absl::AbortedError(
        absl::StrCat(place_.copy, " is of another coordinator, which has gone on from there"));
  }
  if (status.ok()) status = CopyJournal(place_.local, place_.copy);
  if (status.ok()) status = Mark(place_);
  if (status.ok() || !options_.log) return status;
  options_.log({.level = absl::IsAborted(status) ? LogLevel::kError : LogLevel::kWarning,
                .event = "journal_not_copied",
                .message = std::string(status.message())});
  return status;
}

}  // namespace orbweave
