// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/write_job.h"

#include <cstdio>

#include "cli/results/format_dense.h"
#include "cli/results/format_summary.h"
#include "cli/results/write_dense.h"
#include "cli/results/write_outputs.h"
#include "stages/plans.h"

namespace orbweave {
namespace {

absl::Status CheckEnd(const JobStatus& status) {
  switch (status.state) {
    case JobState::kFailed:
      return absl::InternalError(status.error);
    case JobState::kCancelled:
      return absl::CancelledError("the job was cancelled");
    case JobState::kRunning:
      return absl::FailedPreconditionError("job " + status.id.ToShortHex() + " still runs");
    case JobState::kDone:
      break;
  }
  return absl::OkStatus();
}

absl::Status WriteCloud(ClientApi& coordinator,
                        const JobStatus& status,
                        const std::string& folder) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEnd(status));
  ORBWEAVE_ASSIGN_OR_RETURN(const DenseReport report, WriteDense(coordinator, status, folder));
  std::fputs(FormatDense(report, folder).c_str(), stdout);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Verdict> WriteModel(ClientApi& coordinator,
                                   const JobStatus& status,
                                   const std::string& folder,
                                   const FailOn& fail_on) {
  ORBWEAVE_RETURN_IF_ERROR(CheckEnd(status));
  ORBWEAVE_ASSIGN_OR_RETURN(const JobReport report, WriteOutputs(coordinator, status, folder));
  std::fputs(FormatSummary(report, folder).c_str(), stdout);
  if (report.registered > 0) return report.verdict;
  ORBWEAVE_RETURN_IF_ERROR(CheckVerdict(report.verdict, fail_on));
  return absl::InternalError("no image could be registered; the reasons are in " + folder +
                             "/report.html");
}

absl::Status WriteJob(ClientApi& coordinator,
                      const JobStatus& status,
                      const std::string& folder,
                      const FailOn& fail_on) {
  if (status.spec.kind == DenseJob::kKind) return WriteCloud(coordinator, status, folder);
  ORBWEAVE_ASSIGN_OR_RETURN(const Verdict verdict,
                            WriteModel(coordinator, status, folder, fail_on));
  return CheckVerdict(verdict, fail_on);
}

}  // namespace orbweave
