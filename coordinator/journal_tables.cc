// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal_tables.h"

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// Raised when the tables change.
constexpr int64_t kFormat = 1;

constexpr const char* kTables[] = {
    "CREATE TABLE IF NOT EXISTS orbweave (format BIGINT NOT NULL, generation BIGINT NOT NULL)",
    "CREATE TABLE IF NOT EXISTS orbweave_job (id BYTEA PRIMARY KEY, number BIGINT NOT NULL, "
    "state BIGINT NOT NULL, error TEXT NOT NULL, spec BYTEA NOT NULL)",
    "CREATE TABLE IF NOT EXISTS orbweave_attempt (epoch BIGINT PRIMARY KEY, task BYTEA NOT NULL, "
    "job BYTEA NOT NULL, stage TEXT NOT NULL, part BIGINT NOT NULL, worker TEXT NOT NULL, "
    "slot BIGINT NOT NULL, started_s DOUBLE PRECISION NOT NULL, ended_s DOUBLE PRECISION, "
    "reason TEXT)",
    "CREATE INDEX IF NOT EXISTS orbweave_attempt_task ON orbweave_attempt (task)",
    "CREATE INDEX IF NOT EXISTS orbweave_attempt_open ON orbweave_attempt (epoch) "
    "WHERE ended_s IS NULL",
    "CREATE TABLE IF NOT EXISTS orbweave_result (task BYTEA PRIMARY KEY, digest BYTEA NOT NULL, "
    "content BYTEA NOT NULL)"};

}  // namespace

absl::StatusOr<uint64_t> BeginGeneration(SqlDatabase& database) {
  uint64_t generation = 0;
  ORBWEAVE_RETURN_IF_ERROR(database.Transact([&]() -> absl::Status {
    for (const char* table : kTables) ORBWEAVE_RETURN_IF_ERROR(database.Execute(table));
    ORBWEAVE_RETURN_IF_ERROR(
        database.Execute("INSERT INTO orbweave SELECT CAST($1 AS BIGINT), 0 "
                         "WHERE NOT EXISTS (SELECT 1 FROM orbweave)",
                         {kFormat}));
    ORBWEAVE_RETURN_IF_ERROR(database.Execute("UPDATE orbweave SET generation = generation + 1"));
    return database.Query(
        "SELECT format, generation FROM orbweave", {}, [&](const SqlRow& row) -> absl::Status {
          generation = static_cast<uint64_t>(row.Integer(1));
          if (row.Integer(0) == kFormat) return absl::OkStatus();
          return absl::FailedPreconditionError(
              absl::StrCat("the journal has format ",
                           row.Integer(0),
                           ", this version of orbweave writes ",
                           kFormat,
                           ": use the version that wrote it, or another state folder"));
        });
  }));
  return generation;
}

}  // namespace orbweave
