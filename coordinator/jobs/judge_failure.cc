// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/jobs/judge_failure.h"

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

std::string TextOf(const absl::Status& status) {
  return absl::StrCat(absl::StatusCodeToString(status.code()), ": ", status.message());
}

}  // namespace

std::optional<std::string> JudgeFailure(const RetryPolicy& policy,
                                        const TaskRecord& task,
                                        const std::string& worker,
                                        const absl::Status& error,
                                        const JobTally& job) {
  const FailureClass failure = ClassifyFailure(error.code());
  const uint32_t failures = task.failures.Of(failure);
  const bool is_last = failures >= policy.MaxFailures(failure);
  const std::string last = absl::StrCat("last on ", worker, ": ", TextOf(error));
  if (failure == FailureClass::kPermanent) {
    if (is_last || !job.another_may_try) return absl::StrCat(task.Describe(), ": ", TextOf(error));
  } else if (is_last) {
    const char* verb = failure == FailureClass::kProcessLost ? " lost its process " : " failed ";
    return absl::StrCat(
        task.Describe(), verb, failures, " times, ", last, "; ", task.DescribeInputs());
  }
  if (job.failures <= policy.MaxJobRetries(job.tasks)) return std::nullopt;
  return absl::StrCat("the job gave up after ",
                      job.failures,
                      " failed attempts at ",
                      job.tasks,
                      " tasks: ",
                      task.Describe(),
                      ", ",
                      last);
}

}  // namespace orbweave
