// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/sql_journal.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "absl/strings/str_cat.h"
#include "coordinator/journal/journal_rows.h"
#include "coordinator/journal/journal_tables.h"
#include "core/base/fault_point.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {
namespace {

/// Results looked at, and forgotten, at a time.
constexpr size_t kPage = 256;

double SecondsSince1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

/// A damaged result is none that anybody has.
bool IsGarbageRow(const SqlRow& row, const IsGarbage& is_garbage) {
  const absl::StatusOr<Digest> task = DigestFromProto(row.Bytes(0));
  const std::optional<TaskResult> result = ResultFrom(row);
  return !task.ok() || !result || is_garbage(*task, *result);
}

}  // namespace

absl::StatusOr<std::unique_ptr<Journal>> SqlJournal::Open(std::unique_ptr<SqlDatabase> writer,
                                                          std::unique_ptr<SqlDatabase> reader) {
  std::unique_ptr<SqlJournal> journal(new SqlJournal(std::move(writer), std::move(reader)));
  ORBWEAVE_ASSIGN_OR_RETURN(journal->generation_, BeginGeneration(*journal->writer_));
  return journal;
}

SqlJournal::SqlJournal(std::unique_ptr<SqlDatabase> writer, std::unique_ptr<SqlDatabase> reader)
    : writer_(std::move(writer)),
      reader_(std::move(reader)),
      commit_([this](const auto& writes) { return Transact(writes); }) {}

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
    FaultPoint("commit", FaultSide::kBefore);
    return absl::OkStatus();
  });
}

absl::Status SqlJournal::Confirm() {
  return commit_.Commit([] { return absl::OkStatus(); });
}

absl::Status SqlJournal::TrySave() {
  return commit_.Commit([this] {
    return writer_->Execute(
        "INSERT INTO orbweave_probe (id, number) VALUES (0, 0) "
        "ON CONFLICT (id) DO UPDATE SET number = orbweave_probe.number + 1");
  });
}

absl::Status SqlJournal::Commit(std::string_view what, const GroupCommit::Write& write) {
  FaultPoint(what, FaultSide::kBefore);
  ORBWEAVE_RETURN_IF_ERROR(commit_.Commit(write));
  FaultPoint(what, FaultSide::kAfter);
  return absl::OkStatus();
}

absl::Status SqlJournal::SaveJob(const JobEntry& job) {
  const std::string id = ToProto(job.spec.Id());
  const std::string spec = ToProto(job.spec).SerializeAsString();
  return Commit("job", [&] {
    return writer_->Execute(
        "INSERT INTO orbweave_job (id, number, state, error, spec, since_epoch) "
        "VALUES ($1, $2, $3, $4, $5, $6) "
        "ON CONFLICT (id) DO UPDATE SET number = excluded.number, state = excluded.state, "
        "error = excluded.error, spec = excluded.spec, since_epoch = excluded.since_epoch",
        {SqlBytes{id},
         static_cast<int64_t>(job.number),
         static_cast<int64_t>(job.state),
         std::string_view(job.error),
         SqlBytes{spec},
         static_cast<int64_t>(job.since_epoch)});
  });
}

absl::Status SqlJournal::ForgetJob(const Digest& job) {
  const std::string id = ToProto(job);
  return commit_.Commit([&]() -> absl::Status {
    ORBWEAVE_RETURN_IF_ERROR(
        writer_->Execute("DELETE FROM orbweave_attempt WHERE job = $1", {SqlBytes{id}}));
    return writer_->Execute("DELETE FROM orbweave_job WHERE id = $1", {SqlBytes{id}});
  });
}

absl::Status SqlJournal::SaveStarts(const std::vector<Attempt>& attempts) {
  const double now_s = SecondsSince1970();
  return Commit("start", [&]() -> absl::Status {
    for (const Attempt& attempt : attempts) ORBWEAVE_RETURN_IF_ERROR(BeginAttempt(attempt, now_s));
    return absl::OkStatus();
  });
}

absl::Status SqlJournal::BeginAttempt(const Attempt& attempt, double now_s) {
  const std::string task = ToProto(attempt.task);
  const std::string job = ToProto(attempt.job);
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
}

absl::Status SqlJournal::EndAttempt(const AttemptEnd& end) {
  return writer_->Execute(
      "UPDATE orbweave_attempt SET ended_s = $1, reason = $2, code = $3 "
      "WHERE epoch = $4 AND ended_s IS NULL",
      {SecondsSince1970(),
       std::string_view(end.reason),
       static_cast<int64_t>(end.code),
       static_cast<int64_t>(end.epoch)});
}

absl::Status SqlJournal::SaveResult(uint64_t epoch, const Digest& task, const TaskResult& result) {
  const std::string key = ToProto(task);
  const std::string content = ToProto(result).SerializeAsString();
  const std::string digest = ToProto(DigestOf(content));
  return Commit("result", [&]() -> absl::Status {
    ORBWEAVE_RETURN_IF_ERROR(writer_->Execute(
        "INSERT INTO orbweave_result (task, digest, content) VALUES ($1, $2, $3) "
        "ON CONFLICT (task) DO UPDATE SET digest = excluded.digest, content = excluded.content",
        {SqlBytes{key}, SqlBytes{digest}, SqlBytes{content}}));
    return EndAttempt({.epoch = epoch, .code = absl::StatusCode::kOk});
  });
}

absl::Status SqlJournal::SaveEnds(const std::vector<AttemptEnd>& ends) {
  return Commit("ends", [&]() -> absl::Status {
    for (const AttemptEnd& end : ends) ORBWEAVE_RETURN_IF_ERROR(EndAttempt(end));
    return absl::OkStatus();
  });
}

absl::Status SqlJournal::ForgetResultOf(const Digest& task) {
  const std::string key = ToProto(task);
  return commit_.Commit([&] {
    return writer_->Execute("DELETE FROM orbweave_result WHERE task = $1", {SqlBytes{key}});
  });
}

absl::StatusOr<uint64_t> SqlJournal::ForgetResults(const IsGarbage& is_garbage) {
  uint64_t forgotten = 0;
  std::string last;
  for (bool is_end = false; !is_end;) {
    std::vector<std::string> candidates;
    ORBWEAVE_ASSIGN_OR_RETURN(is_end, ReadPage(is_garbage, last, candidates));
    uint64_t in_page = 0;
    const auto forget = [&]() -> absl::Status {
      in_page = 0;
      for (const std::string& task : candidates) {
        ORBWEAVE_ASSIGN_OR_RETURN(const bool goes, ForgetResult(task, is_garbage));
        in_page += goes ? 1 : 0;
      }
      return absl::OkStatus();
    };
    if (!candidates.empty()) ORBWEAVE_RETURN_IF_ERROR(commit_.Commit(forget));
    forgotten += in_page;
  }
  return forgotten;
}

absl::StatusOr<bool> SqlJournal::ReadPage(const IsGarbage& is_garbage,
                                          std::string& last,
                                          std::vector<std::string>& candidates) {
  static const std::string sql = absl::StrCat("SELECT ",
                                              kResultColumns,
                                              " FROM orbweave_result WHERE task > $1 "
                                              "ORDER BY task LIMIT ",
                                              kPage);
  const std::string after = last;
  size_t rows = 0;
  const std::lock_guard lock(reading_mutex_);
  ORBWEAVE_RETURN_IF_ERROR(reader_->Query(sql, {SqlBytes{after}}, [&](const SqlRow& row) {
    ++rows;
    last = row.Bytes(0);
    if (IsGarbageRow(row, is_garbage)) candidates.push_back(last);
    return absl::OkStatus();
  }));
  return rows < kPage;
}

absl::StatusOr<bool> SqlJournal::ForgetResult(const std::string& task,
                                              const IsGarbage& is_garbage) {
  static const std::string sql =
      absl::StrCat("SELECT ", kResultColumns, " FROM orbweave_result WHERE task = $1");
  bool goes = false;
  ORBWEAVE_RETURN_IF_ERROR(writer_->Query(sql, {SqlBytes{task}}, [&](const SqlRow& row) {
    goes = IsGarbageRow(row, is_garbage);
    return absl::OkStatus();
  }));
  if (!goes) return false;
  ORBWEAVE_RETURN_IF_ERROR(
      writer_->Execute("DELETE FROM orbweave_result WHERE task = $1", {SqlBytes{task}}));
  return true;
}

absl::Status SqlJournal::SaveBlames(const std::vector<WorkerBlame>& blames) {
  return commit_.Commit([&]() -> absl::Status {
    for (const WorkerBlame& blame : blames) {
      if (blame.blames == 0) {
        ORBWEAVE_RETURN_IF_ERROR(writer_->Execute("DELETE FROM orbweave_blame WHERE worker = $1",
                                                  {std::string_view(blame.worker)}));
        continue;
      }
      ORBWEAVE_RETURN_IF_ERROR(writer_->Execute(
          "INSERT INTO orbweave_blame (worker, process, blames) VALUES ($1, $2, $3) "
          "ON CONFLICT (worker) DO UPDATE SET process = excluded.process, "
          "blames = excluded.blames",
          {std::string_view(blame.worker),
           static_cast<int64_t>(blame.process),
           int64_t{blame.blames}}));
    }
    return absl::OkStatus();
  });
}

}  // namespace orbweave
