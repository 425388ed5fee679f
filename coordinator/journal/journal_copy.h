// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "coordinator/journal/journal.h"
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

struct CopyRule {
  EventLog log{};  ///< told of copies that could not be made
  double every_s = 60.0;
};

/// The local journal, which keeps the copy fresh as long as it is open: at once, so that nobody
/// begins the same generation again, then each minute in which something changed, and at the end.
/// First the copy takes its place, unless it is the very one that the local journal made last: then
/// no other machine went on meanwhile. Where there is no copy the journal begins anew. A copy that
/// another machine made is left alone, and Confirm says FailedPrecondition: the journal was taken
/// over. What is newer than the copy is computed again when the machine is lost, to the same bytes.
/// FailedPrecondition: the local one would be on a shared file system, too. PermissionDenied:
/// others could write its folder. Errors of OpenSqliteJournal.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenCopiedJournal(const JournalPlace& place,
                                                                         CopyRule rule = {});

/// The journal of a state folder on a shared file system, to look at what is there: what is written
/// to it is lost.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenJournalToLook(
    const std::string& state_dir);

}  // namespace orbweave
