// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/sql_journal.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

/// Raised when the tables change.
constexpr int64_t kFormat = 1;
/// Tasks looked up by one statement.
constexpr size_t kLookup = 64;

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

constexpr const char* kAttemptColumns =
    "epoch, task, job, stage, part, worker, slot, started_s, ended_s, reason";

double SecondsSince1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// The text of a statement's columns from $first on: "$1, $2, $3".
std::string Parameters(size_t count) {
  std::string text;
  for (size_t i = 1; i <= count; ++i) absl::StrAppend(&text, i > 1 ? ", $" : "$", i);
  return text;
}

absl::StatusOr<Attempt> AttemptFrom(const SqlRow& row) {
  Attempt attempt{.epoch = static_cast<uint64_t>(row.Integer(0)),
                  .stage = std::string(row.Bytes(3)),
                  .part = static_cast<uint32_t>(row.Integer(4)),
                  .worker = std::string(row.Bytes(5)),
                  .slot = static_cast<uint32_t>(row.Integer(6))};
  ORBWEAVE_ASSIGN_OR_RETURN(attempt.task, DigestFromProto(row.Bytes(1)));
  ORBWEAVE_ASSIGN_OR_RETURN(attempt.job, DigestFromProto(row.Bytes(2)));
  return attempt;
}

/// The result in a row (task, digest, content), unless it is damaged.
std::optional<TaskResult> ResultFrom(const SqlRow& row) {
  v1::TaskResult proto;
  const std::string content(row.Bytes(2));
  if (ToProto(DigestOf(content)) != row.Bytes(1) || !proto.ParseFromString(content)) return {};
  absl::StatusOr<TaskResult> result = FromProto(proto);
  return result.ok() ? std::optional(*std::move(result)) : std::nullopt;
}

}  // namespace

absl::StatusOr<std::unique_ptr<Journal>> SqlJournal::Open(std::unique_ptr<SqlDatabase> writer,
                                                          std::unique_ptr<SqlDatabase> reader) {
  std::unique_ptr<SqlJournal> journal(new SqlJournal(std::move(writer), std::move(reader)));
  ORBWEAVE_RETURN_IF_ERROR(journal->Begin());
  return journal;
}

SqlJournal::SqlJournal(std::unique_ptr<SqlDatabase> writer, std::unique_ptr<SqlDatabase> reader)
    : writer_(std::move(writer)),
      reader_(std::move(reader)),
      commit_([this](const auto& writes) { return Transact(writes); }) {}

absl::Status SqlJournal::Begin() {
  return writer_->Transact([this]() -> absl::Status {
    for (const char* table : kTables) ORBWEAVE_RETURN_IF_ERROR(writer_->Execute(table));
    ORBWEAVE_RETURN_IF_ERROR(
        writer_->Execute("INSERT INTO orbweave SELECT CAST($1 AS BIGINT), 0 "
                         "WHERE NOT EXISTS (SELECT 1 FROM orbweave)",
                         {kFormat}));
    ORBWEAVE_RETURN_IF_ERROR(writer_->Execute("UPDATE orbweave SET generation = generation + 1"));
    return writer_->Query(
        "SELECT format, generation FROM orbweave", {}, [this](const SqlRow& row) -> absl::Status {
          generation_ = static_cast<uint64_t>(row.Integer(1));
          if (row.Integer(0) == kFormat) return absl::OkStatus();
          return absl::FailedPreconditionError(
              absl::StrCat("the journal has format ",
                           row.Integer(0),
                           ", this version of orbweave writes ",
                           kFormat,
                           ": use the version that wrote it, or another state folder"));
        });
  });
}

absl::Status SqlJournal::Transact(const std::vector<const GroupCommit::Write*>& writes) {
  return writer_->Transact([&]() -> absl::Status {
    bool is_mine = false;
    ORBWEAVE_RETURN_IF_ERROR(
        writer_->Query("SELECT generation FROM orbweave", {}, [&](const SqlRow& row) {
          is_mine = static_cast<uint64_t>(row.Integer(0)) == generation_;
          return absl::OkStatus();
        }));
    if (!is_mine)
      return absl::FailedPreconditionError("another coordinator has taken the journal over");
    for (const GroupCommit::Write* write : writes) ORBWEAVE_RETURN_IF_ERROR((*write)());
    return absl::OkStatus();
  });
}

absl::Status SqlJournal::SaveJob(const JobEntry& job) {
  const std::string id = ToProto(job.spec.Id());
  const std::string spec = ToProto(job.spec).SerializeAsString();
  return commit_.Commit([&] {
    return writer_->Execute(
        "INSERT INTO orbweave_job (id, number, state, error, spec) VALUES ($1, $2, $3, $4, $5) "
        "ON CONFLICT (id) DO UPDATE SET number = excluded.number, state = excluded.state, "
        "error = excluded.error, spec = excluded.spec",
        {SqlBytes{id},
         static_cast<int64_t>(job.number),
         static_cast<int64_t>(job.state),
         std::string_view(job.error),
         SqlBytes{spec}});
  });
}

absl::StatusOr<std::vector<JobEntry>> SqlJournal::LoadJobs() {
  const std::lock_guard lock(reading_mutex_);
  std::vector<JobEntry> jobs;
  ORBWEAVE_RETURN_IF_ERROR(reader_->Query(
      "SELECT number, state, error, spec FROM orbweave_job ORDER BY number",
      {},
      [&jobs](const SqlRow& row) -> absl::Status {
        JobEntry job{.error = std::string(row.Bytes(2)),
                     .number = static_cast<uint64_t>(row.Integer(0))};
        ORBWEAVE_ASSIGN_OR_RETURN(job.state,
                                  JobStateFromProto(static_cast<uint32_t>(row.Integer(1))));
        v1::JobSpec spec;
        if (!spec.ParseFromString(std::string(row.Bytes(3))))
          return absl::DataLossError(absl::StrCat("job ", job.number, " is damaged"));
        ORBWEAVE_ASSIGN_OR_RETURN(job.spec, FromProto(spec));
        jobs.push_back(std::move(job));
        return absl::OkStatus();
      }));
  return jobs;
}

absl::Status SqlJournal::SaveStart(const Attempt& attempt) {
  const std::string task = ToProto(attempt.task);
  const std::string job = ToProto(attempt.job);
  const double now_s = SecondsSince1970();
  return commit_.Commit([&] {
    return writer_->Execute(
        "INSERT INTO orbweave_attempt (epoch, task, job, stage, part, worker, slot, started_s) "
        "VALUES ($1, $2, $3, $4, $5, $6, $7, $8) ON CONFLICT (epoch) DO NOTHING",
        {static_cast<int64_t>(attempt.epoch),
         SqlBytes{task},
         SqlBytes{job},
         std::string_view(attempt.stage),
         int64_t{attempt.part},
         std::string_view(attempt.worker),
         int64_t{attempt.slot},
         now_s});
  });
}

absl::Status SqlJournal::EndAttempt(uint64_t epoch, std::string_view reason) {
  return writer_->Execute(
      "UPDATE orbweave_attempt SET ended_s = $1, reason = $2 WHERE epoch = $3 AND ended_s IS NULL",
      {SecondsSince1970(), reason, static_cast<int64_t>(epoch)});
}

absl::Status SqlJournal::SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) {
  const std::string key = ToProto(task);
  const std::string content = ToProto(result).SerializeAsString();
  const std::string digest = ToProto(DigestOf(content));
  return commit_.Commit([&]() -> absl::Status {
    ORBWEAVE_RETURN_IF_ERROR(writer_->Execute(
        "INSERT INTO orbweave_result (task, digest, content) VALUES ($1, $2, $3) "
        "ON CONFLICT (task) DO UPDATE SET digest = excluded.digest, content = excluded.content",
        {SqlBytes{key}, SqlBytes{digest}, SqlBytes{content}}));
    return EndAttempt(epoch, "");
  });
}

absl::Status SqlJournal::SaveEnds(const std::vector<AttemptEnd>& ends) {
  return commit_.Commit([&]() -> absl::Status {
    for (const AttemptEnd& end : ends) ORBWEAVE_RETURN_IF_ERROR(EndAttempt(end.epoch, end.reason));
    return absl::OkStatus();
  });
}

absl::StatusOr<std::vector<std::optional<TaskResult>>> SqlJournal::LoadResults(
    const std::vector<Digest>& tasks) {
  static const std::string sql =
      absl::StrCat("SELECT task, digest, content FROM orbweave_result WHERE task IN (",
                   Parameters(kLookup),
                   ")");
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
        AttemptRecord& record = records.emplace_back();
        ORBWEAVE_ASSIGN_OR_RETURN(record.attempt, AttemptFrom(row));
        record.started_s = row.Number(7);
        if (row.IsNull(8)) return absl::OkStatus();
        record.ended_s = row.Number(8);
        record.reason = std::string(row.Bytes(9));
        return absl::OkStatus();
      }));
  return records;
}

}  // namespace orbweave
