// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal_copy.h"

#include <fcntl.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
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

/// Of a journal; 0: there is none.
absl::StatusOr<int64_t> GenerationOf(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return 0;
  ORBWEAVE_ASSIGN_OR_RETURN(const SqliteConnection journal, SqliteConnection::OpenToWrite(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const bool is_begun, journal.HasTable("orbweave"));
  if (!is_begun) return 0;
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteStatement statement,
                            journal.Prepare("SELECT generation FROM orbweave"));
  ORBWEAVE_ASSIGN_OR_RETURN(const bool has_row, statement.Step());
  return has_row ? statement.Integer(0) : 0;
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
  return {.local = absl::StrCat(
              journal_folder, "/orbweave-journal-", DigestOf(state).ToShortHex(), ".db"),
          .copy = state_dir + "/journal.db"};
}

absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place) {
  const std::string folder = fs::path(place.local).parent_path().string();
  ORBWEAVE_RETURN_IF_ERROR(MakeFolder(folder));
  if (const std::string_view shared = SharedFileSystemOf(folder); !shared.empty()) {
    return absl::FailedPreconditionError(absl::StrCat(
        folder, " is on ", std::string(shared), ": the journal needs a disk of this machine"));
  }
  ORBWEAVE_RETURN_IF_ERROR(EndLog(place.copy));
  ORBWEAVE_ASSIGN_OR_RETURN(const int64_t local, GenerationOf(place.local));
  ORBWEAVE_ASSIGN_OR_RETURN(const int64_t copy, GenerationOf(place.copy));
  if (local < copy) {
    ORBWEAVE_RETURN_IF_ERROR(EndLog(place.local));
    ORBWEAVE_RETURN_IF_ERROR(CopyJournal(place.copy, place.local));
  }
  return OpenSqliteJournal(place.local);
}

absl::StatusOr<std::unique_ptr<JournalCopy>> JournalCopy::Start(const JournalPlace& place,
                                                                EventLog log,
                                                                double every_s) {
  std::unique_ptr<JournalCopy> copy(new JournalCopy(place, std::move(log)));
  ORBWEAVE_RETURN_IF_ERROR(copy->Copy());
  ORBWEAVE_ASSIGN_OR_RETURN(SqliteConnection watched, SqliteConnection::OpenToWrite(place.local));
  copy->thread_ = std::jthread(
      [raw = copy.get(), every_s, watched = std::move(watched)](const std::stop_token& stop) {
        int64_t copied = 0;  // no version is
        while (SleepUnlessStopped(every_s, stop)) {
          const absl::StatusOr<int64_t> version = VersionOf(watched);
          if (version.ok() && *version == copied) continue;
          raw->CopyOrTell();
          copied = version.value_or(copied);
        }
      });
  return copy;
}

JournalCopy::~JournalCopy() {
  thread_ = {};
  CopyOrTell();
}

absl::Status JournalCopy::Copy() const {
  ORBWEAVE_ASSIGN_OR_RETURN(const int64_t local, GenerationOf(place_.local));
  ORBWEAVE_ASSIGN_OR_RETURN(const int64_t copy, GenerationOf(place_.copy));
  if (copy > local) {
    return absl::AbortedError(
        absl::StrCat(place_.copy, " is of another coordinator, which has gone on from there"));
  }
  return CopyJournal(place_.local, place_.copy);
}

void JournalCopy::CopyOrTell() const {
  const absl::Status status = Copy();
  if (status.ok() || !log_) return;
  log_({.level = LogLevel::kWarning,
        .event = "journal_not_copied",
        .message = std::string(status.message())});
}

}  // namespace orbweave
