// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/journal/journal.h"

namespace orbweave {

/// The journal in an SQLite file (write-ahead log, synchronous = FULL), which is made when there is
/// none. The caller sees to it that one process has it (StateLock). DataLoss: the file is damaged.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenSqliteJournal(const std::string& path);

}  // namespace orbweave
