// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What an SQL journal answers.

#include <algorithm>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/journal_rows.h"
#include "coordinator/journal/sql_journal.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

/// Tasks looked up by one statement.
constexpr size_t kLookup = 64;

/// The text of a statement's columns from $first on: "$1, $2, $3".
std::string Parameters(size_t count) {
  std::string text;
  for (size_t i = 1; i <= count; ++i) absl::StrAppend(&text, i > 1 ? ", $" : "$", i);
  return text;
}

}  // namespace

absl::StatusOr<std::vector<JobEntry>> SqlJournal::LoadJobs() {
  const std::lock_guard lock(reading_mutex_);
  std::vector<JobEntry> jobs;
  ORBWEAVE_RETURN_IF_ERROR(
      reader_->Query(absl::StrCat("SELECT ", kJobColumns, " FROM orbweave_job ORDER BY number"),
                     {},
                     [&jobs](const SqlRow& row) -> absl::Status {
                       ORBWEAVE_ASSIGN_OR_RETURN(jobs.emplace_back(), JobFrom(row));
                       return absl::OkStatus();
                     }));
  return jobs;
}

absl::StatusOr<std::vector<std::optional<TaskResult>>> SqlJournal::LoadResults(
    const std::vector<Digest>& tasks) {
  static const std::string sql = absl::StrCat(
      "SELECT ", kResultColumns, " FROM orbweave_result WHERE task IN (", Parameters(kLookup), ")");
  std::map<std::string, TaskResult, std::less<>> found;
  std::vector<std::string> keys;
  for (const Digest& task : tasks) keys.push_back(ToProto(task));
  for (size_t begin = 0; begin < keys.size(); begin += kLookup) {
    std::vector<SqlValue> values;
    for (size_t i = 0; i < kLookup; ++i)
      values.push_back(SqlBytes{keys[std::min(begin + i, keys.size() - 1)]});
    const std::lock_guard lock(reading_mutex_);
    ORBWEAVE_RETURN_IF_ERROR(reader_->Query(sql, values, [&found](const SqlRow& row) {
      if (std::optional<TaskResult> result = ResultFrom(row))
        found.emplace(row.Bytes(0), *std::move(result));
      return absl::OkStatus();
    }));
  }
  std::vector<std::optional<TaskResult>> results;
  for (const std::string& key : keys) {
    const auto it = found.find(key);
    results.push_back(it == found.end() ? std::nullopt : std::optional(it->second));
  }
  return results;
}

absl::StatusOr<std::vector<Attempt>> SqlJournal::LoadOpenAttempts() {
  static const std::string sql = absl::StrCat(
      "SELECT ", kAttemptColumns, " FROM orbweave_attempt WHERE ended_s IS NULL ORDER BY epoch");
  const std::lock_guard lock(reading_mutex_);
  std::vector<Attempt> attempts;
  ORBWEAVE_RETURN_IF_ERROR(reader_->Query(sql, {}, [&](const SqlRow& row) -> absl::Status {
    ORBWEAVE_ASSIGN_OR_RETURN(attempts.emplace_back(), AttemptFrom(row));
    return absl::OkStatus();
  }));
  return attempts;
}

absl::StatusOr<std::vector<AttemptRecord>> SqlJournal::LoadAttempts(const Digest& task) {
  static const std::string sql = absl::StrCat(
      "SELECT ", kAttemptColumns, " FROM orbweave_attempt WHERE task = $1 ORDER BY epoch");
  const std::string key = ToProto(task);
  const std::lock_guard lock(reading_mutex_);
  std::vector<AttemptRecord> records;
  ORBWEAVE_RETURN_IF_ERROR(
      reader_->Query(sql, {SqlBytes{key}}, [&records](const SqlRow& row) -> absl::Status {
        ORBWEAVE_ASSIGN_OR_RETURN(records.emplace_back(), AttemptRecordFrom(row));
        return absl::OkStatus();
      }));
  return records;
}

absl::StatusOr<std::vector<FailedAttempt>> SqlJournal::LoadFailures(const Digest& job,
                                                                    uint64_t since_epoch) {
  static const std::string sql =
      absl::StrCat("SELECT ",
                   kFailureColumns,
                   " FROM orbweave_attempt WHERE job = $1 AND epoch > $2 AND code > 1 "
                   "ORDER BY epoch");  // 0 is OK, 1 Cancelled
  const std::string key = ToProto(job);
  const std::lock_guard lock(reading_mutex_);
  std::vector<FailedAttempt> failures;
  ORBWEAVE_RETURN_IF_ERROR(reader_->Query(sql,
                                          {SqlBytes{key}, static_cast<int64_t>(since_epoch)},
                                          [&failures](const SqlRow& row) -> absl::Status {
                                            ORBWEAVE_ASSIGN_OR_RETURN(failures.emplace_back(),
                                                                      FailedAttemptFrom(row));
                                            return absl::OkStatus();
                                          }));
  return failures;
}

absl::StatusOr<std::vector<WorkerBlame>> SqlJournal::LoadBlames() {
  const std::lock_guard lock(reading_mutex_);
  std::vector<WorkerBlame> blames;
  ORBWEAVE_RETURN_IF_ERROR(reader_->Query(
      "SELECT worker, process, blames FROM orbweave_blame WHERE blames > 0 ORDER BY worker",
      {},
      [&blames](const SqlRow& row) {
        blames.push_back({std::string(row.Bytes(0)),
                          static_cast<uint64_t>(row.Integer(1)),
                          static_cast<uint32_t>(row.Integer(2))});
        return absl::OkStatus();
      }));
  return blames;
}

}  // namespace orbweave
