// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/journal_rows.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "proto/codec/coordinator_codec.h"

namespace orbweave {

absl::StatusOr<JobEntry> JobFrom(const SqlRow& row) {
  JobEntry job{.error = std::string(row.Bytes(2)),
               .number = static_cast<uint64_t>(row.Integer(0)),
               .since_epoch = static_cast<uint64_t>(row.Integer(4))};
  ORBWEAVE_ASSIGN_OR_RETURN(job.state, JobStateFromProto(static_cast<uint32_t>(row.Integer(1))));
  v1::JobSpec spec;
  if (!spec.ParseFromString(std::string(row.Bytes(3))))
    return absl::DataLossError(absl::StrCat("job ", job.number, " is damaged"));
  ORBWEAVE_ASSIGN_OR_RETURN(job.spec, FromProto(spec));
  return job;
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

absl::StatusOr<AttemptRecord> AttemptRecordFrom(const SqlRow& row) {
  AttemptRecord record{.started_s = row.Number(7)};
  ORBWEAVE_ASSIGN_OR_RETURN(record.attempt, AttemptFrom(row));
  if (row.IsNull(8)) return record;
  record.ended_s = row.Number(8);
  record.reason = std::string(row.Bytes(9));
  return record;
}

absl::StatusOr<FailedAttempt> FailedAttemptFrom(const SqlRow& row) {
  FailedAttempt failure{.worker = std::string(row.Bytes(1)),
                        .code = static_cast<absl::StatusCode>(row.Integer(2)),
                        .reason = std::string(row.Bytes(3))};
  ORBWEAVE_ASSIGN_OR_RETURN(failure.task, DigestFromProto(row.Bytes(0)));
  return failure;
}

std::optional<TaskResult> ResultFrom(const SqlRow& row) {
  v1::TaskResult proto;
  const std::string content(row.Bytes(2));
  if (ToProto(DigestOf(content)) != row.Bytes(1) || !proto.ParseFromString(content)) return {};
  absl::StatusOr<TaskResult> result = FromProto(proto);
  return result.ok() ? std::optional(*std::move(result)) : std::nullopt;
}

}  // namespace orbweave
