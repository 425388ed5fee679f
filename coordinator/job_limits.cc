// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coordinator/job_limits.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "coordinator/traceparent.h"

namespace orbweave {
namespace {

constexpr size_t kMostBlobsOfAResult = 200'000;

absl::Status CheckLength(const std::string& what, size_t length, size_t most) {
  if (length <= most) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(what, " of ", length, "; at most ", most, " are taken"));
}

}  // namespace

absl::Status CheckSizeOf(const JobSpec& spec) {
  ORBWEAVE_RETURN_IF_ERROR(CheckLength("a job's kind, in bytes,", spec.kind.size(), 64));
  ORBWEAVE_RETURN_IF_ERROR(CheckLength("a job's label, in bytes,", spec.label.size(), 1024));
  ORBWEAVE_RETURN_IF_ERROR(
      CheckLength("a job's options, in bytes,", spec.options_text.size(), 16 * 1024));
  if (!spec.traceparent.empty())
    ORBWEAVE_RETURN_IF_ERROR(ParseTraceparent(spec.traceparent).status());
  return CheckLength("a job's inputs", spec.inputs.size(), 64);
}

absl::Status CheckSizeOf(const TaskResult& result) {
  ORBWEAVE_RETURN_IF_ERROR(
      CheckLength("a task's report, in bytes,", result.report_json.size(), 1 << 20));
  return CheckLength(
      "a task's blobs", result.outputs.size() + result.recipes.size(), kMostBlobsOfAResult);
}

absl::Status Shortened(const absl::Status& error) {
  constexpr size_t kMost = 4000;
  if (error.message().size() <= kMost) return error;
  absl::Status shortened(error.code(), error.message().substr(0, kMost));
  error.ForEachPayload([&shortened](absl::string_view name, const absl::Cord& payload) {
    shortened.SetPayload(name, payload);
  });
  return shortened;
}

}  // namespace orbweave
