// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "coordinator/journal.h"
#include "core/base/status.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// The name of a file system that several machines share, where the log and the locks of SQLite
/// cannot be relied on; empty: `path` is on none.
[[nodiscard]] std::string_view SharedFileSystemOf(const std::string& path);

/// A journal on a disk of this machine, and its copy on storage that the next machine sees.
struct JournalPlace {
  std::string local{};
  std::string copy{};
};

/// Of a coordinator with this state folder, in a folder that may hold those of others and of other
/// users.
[[nodiscard]] JournalPlace PlaceJournal(const std::string& state_dir,
                                        const std::string& journal_folder);

/// Opens the local journal; but the copy takes its place first, unless it is the very one that the
/// local journal made last: then no other machine went on meanwhile. Where there is no copy the
/// journal begins anew. FailedPrecondition: the local one would be on a shared file system, too.
/// PermissionDenied: others could write its folder. Errors of OpenSqliteJournal.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place);

/// The journal of a state folder on a shared file system, to look at what is there: what is written
/// to it is lost.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenJournalToLook(
    const std::string& state_dir);

struct JournalCopyOptions {
  EventLog log{};
  std::function<void(const absl::Status& why)> lost{};  ///< called once when Lost
  double every_s = 60.0;
};

/// Keeps the copy fresh as long as it lives: at once, so that nobody begins the same generation
/// again, then each minute in which something changed, and at the end. Lost: the copy was made by
/// another machine, which has gone on from there; it is left alone. What is newer than the copy is
/// computed again when the machine is lost, to the same bytes.
class JournalCopy {
 public:
  /// Aborted: it is Lost.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<JournalCopy>> Start(
      const JournalPlace& place, JournalCopyOptions options);
  ~JournalCopy();
  JournalCopy(const JournalCopy&) = delete;
  JournalCopy& operator=(const JournalCopy&) = delete;

 private:
  JournalCopy(JournalPlace place, JournalCopyOptions options)
      : place_(std::move(place)), options_(std::move(options)) {}
  /// What went wrong was logged.
  [[nodiscard]] absl::Status CopyOrTell() const;

  JournalPlace place_;
  JournalCopyOptions options_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
