// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "coordinator/journal/sql_database.h"

namespace orbweave {

/// Makes the tables of a journal that are missing: `orbweave` (format and generation),
/// `orbweave_job`, `orbweave_attempt`, `orbweave_result`, `orbweave_blame`, `orbweave_probe`; those
/// of an earlier format are brought up to date. Begins a generation and returns it.
/// FailedPrecondition: the tables are of another format.
[[nodiscard]] absl::StatusOr<uint64_t> BeginGeneration(SqlDatabase& database);

}  // namespace orbweave
