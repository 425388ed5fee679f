// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <thread>

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

/// Of a coordinator with this state folder, in a folder that may hold those of others.
[[nodiscard]] JournalPlace PlaceJournal(const std::string& state_dir,
                                        const std::string& journal_folder);

/// Opens the local journal. The copy takes its place first, unless it is of the same generation or
/// a later one (Journal::generation), and so no other machine went on meanwhile.
/// FailedPrecondition: the local one would be on a shared file system, too. Errors of
/// OpenSqliteJournal.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place);

/// Keeps the copy fresh as long as it lives: at once, so that nobody begins the same generation
/// again, then each minute in which something changed, and at the end; but leaves one alone that is
/// of a later generation: another machine has gone on. What is newer than the copy is computed
/// again when the machine is lost, to the same bytes.
class JournalCopy {
 public:
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<JournalCopy>> Start(const JournalPlace& place,
                                                                          EventLog log,
                                                                          double every_s = 60.0);
  ~JournalCopy();
  JournalCopy(const JournalCopy&) = delete;
  JournalCopy& operator=(const JournalCopy&) = delete;

 private:
  JournalCopy(JournalPlace place, EventLog log) : place_(std::move(place)), log_(std::move(log)) {}
  [[nodiscard]] absl::Status Copy() const;
  void CopyOrTell() const;

  JournalPlace place_;
  EventLog log_;
  std::jthread thread_;  ///< last: ends before what it uses
};

}  // namespace orbweave
