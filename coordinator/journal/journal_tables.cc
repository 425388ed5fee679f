// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_tables.h"

#include <span>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// Raised when the tables change.
constexpr int64_t kFormat = 2;

constexpr const char* kTables[] = {
    "CREATE TABLE IF NOT EXISTS orbweave_job (id BYTEA PRIMARY KEY, number BIGINT NOT NULL, "
    "state BIGINT NOT NULL, error TEXT NOT NULL, spec BYTEA NOT NULL, "
    "since_epoch BIGINT NOT NULL DEFAULT 0)",
    "CREATE TABLE IF NOT EXISTS orbweave_attempt (epoch BIGINT PRIMARY KEY, task BYTEA NOT NULL, "
    "job BYTEA NOT NULL, stage TEXT NOT NULL, part BIGINT NOT NULL, worker TEXT NOT NULL, "
    "slot BIGINT NOT NULL, started_s DOUBLE PRECISION NOT NULL, ended_s DOUBLE PRECISION, "
    "reason TEXT, code BIGINT)",
    "CREATE INDEX IF NOT EXISTS orbweave_attempt_task ON orbweave_attempt (task)",
    "CREATE INDEX IF NOT EXISTS orbweave_attempt_open ON orbweave_attempt (epoch) "
    "WHERE ended_s IS NULL",
    "CREATE INDEX IF NOT EXISTS orbweave_attempt_failed ON orbweave_attempt (job) WHERE code > 1",
    "CREATE TABLE IF NOT EXISTS orbweave_result (task BYTEA PRIMARY KEY, digest BYTEA NOT NULL, "
    "content BYTEA NOT NULL)",
    "CREATE TABLE IF NOT EXISTS orbweave_blame (worker TEXT PRIMARY KEY, process BIGINT NOT NULL, "
    "blames BIGINT NOT NULL)",
    "CREATE TABLE IF NOT EXISTS orbweave_probe (id BIGINT PRIMARY KEY, number BIGINT NOT NULL)"};

/// Tables of format 1 as those of format 2: failures of that time count for nothing.
constexpr const char* kFromFormat1[] = {
    "ALTER TABLE orbweave_job ADD COLUMN since_epoch BIGINT NOT NULL DEFAULT 0",
    "ALTER TABLE orbweave_attempt ADD COLUMN code BIGINT",
    "UPDATE orbweave SET format = 2"};

absl::Status ExecuteAll(SqlDatabase& database, std::span<const char* const> statements) {
  for (const char* statement : statements) ORBWEAVE_RETURN_IF_ERROR(database.Execute(statement));
  return absl::OkStatus();
}

absl::Status BringUpToDate(SqlDatabase& database) {
  int64_t format = 0;
  ORBWEAVE_RETURN_IF_ERROR(
      database.Query("SELECT format FROM orbweave", {}, [&format](const SqlRow& row) {
        format = row.Integer(0);
        return absl::OkStatus();
      }));
  if (format == 1) return ExecuteAll(database, kFromFormat1);
  if (format == kFormat) return absl::OkStatus();
  return absl::FailedPreconditionError(
      absl::StrCat("the journal has format ",
                   format,
                   ", this version of orbweave writes ",
                   kFormat,
                   ": use the version that wrote it, or another state folder"));
}

}  // namespace

absl::StatusOr<uint64_t> BeginGeneration(SqlDatabase& database) {
  uint64_t generation = 0;
  const auto begin = [&]() -> absl::Status {
    ORBWEAVE_RETURN_IF_ERROR(
        database.Execute("CREATE TABLE IF NOT EXISTS orbweave (format BIGINT NOT NULL, "
                         "generation BIGINT NOT NULL)"));
    ORBWEAVE_RETURN_IF_ERROR(
        database.Execute("INSERT INTO orbweave SELECT CAST($1 AS BIGINT), 0 "
                         "WHERE NOT EXISTS (SELECT 1 FROM orbweave)",
                         {kFormat}));
    ORBWEAVE_RETURN_IF_ERROR(BringUpToDate(database));
    ORBWEAVE_RETURN_IF_ERROR(ExecuteAll(database, kTables));
    ORBWEAVE_RETURN_IF_ERROR(database.Execute("UPDATE orbweave SET generation = generation + 1"));
    return database.Query("SELECT generation FROM orbweave", {}, [&](const SqlRow& row) {
      generation = static_cast<uint64_t>(row.Integer(0));
      return absl::OkStatus();
    });
  };
  ORBWEAVE_RETURN_IF_ERROR(database.Transact(begin));
  return generation;
}

}  // namespace orbweave
