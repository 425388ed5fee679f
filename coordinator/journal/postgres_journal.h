// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "coordinator/journal/journal.h"

namespace orbweave {

/// The journal in a PostgreSQL database, for a coordinator that is to be started on another machine
/// when its own is lost. `url` as libpq knows it ("postgresql://user@host/database",
/// "service=orbweave"); its tables are in the first schema of the connection's search path. The
/// coordinator that has the journal holds an advisory lock of that schema.
///
/// InvalidArgument: `url` is none, or holds a password, which others could read in the list of
/// processes: it belongs into ~/.pgpass, the file that PGPASSFILE or passfile=... names, or a
/// service file. FailedPrecondition: another coordinator has the journal. Unavailable: the server
/// cannot be reached, or does not let us in.
[[nodiscard]] absl::StatusOr<std::unique_ptr<Journal>> OpenPostgresJournal(const std::string& url);

}  // namespace orbweave
