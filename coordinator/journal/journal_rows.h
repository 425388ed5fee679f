// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "coordinator/journal/journal.h"
#include "coordinator/journal/sql_database.h"

namespace orbweave {

/// Rows of the journal's tables as values. Errors: DataLoss or InvalidArgument, of a damaged row.

inline constexpr const char* kJobColumns = "number, state, error, spec, since_epoch";
[[nodiscard]] absl::StatusOr<JobEntry> JobFrom(const SqlRow& row);

inline constexpr const char* kAttemptColumns =
    "epoch, task, job, stage, part, worker, slot, started_s, ended_s, reason";
[[nodiscard]] absl::StatusOr<Attempt> AttemptFrom(const SqlRow& row);
[[nodiscard]] absl::StatusOr<AttemptRecord> AttemptRecordFrom(const SqlRow& row);

inline constexpr const char* kFailureColumns = "task, worker, code, reason";
[[nodiscard]] absl::StatusOr<FailedAttempt> FailedAttemptFrom(const SqlRow& row);

inline constexpr const char* kResultColumns = "task, digest, content";
/// Nothing when it is damaged.
[[nodiscard]] std::optional<TaskResult> ResultFrom(const SqlRow& row);

}  // namespace orbweave
