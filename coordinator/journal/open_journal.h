// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/journal/journal.h"
#include "core/pipeline/log_event.h"

namespace orbweave {

/// The journal of a coordinator whose state is in `state_dir`. FailedPrecondition: the folder was
/// written by a version that kept results in files, or is on a file system that machines share.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenJournal(const std::string& state_dir);

/// The journal of a state folder: in `journal_folder`, with a copy beside the state, or, where that
/// is empty, in the state folder itself. Errors of OpenJournal and OpenCopiedJournal.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenJournalIn(
    const std::string& journal_folder, const std::string& state_dir, const EventLog& log);

}  // namespace orbweave
