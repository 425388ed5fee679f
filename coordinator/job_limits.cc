// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "coordinator/job_limits.h"

#include <string>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

absl::Status CheckLength(const std::string& what, size_t length, size_t most) {
  if (length <= most) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat("a job's ", what, " of ", length, "; at most ", most, " are taken"));
}

}  // namespace

absl::Status CheckSizeOf(const JobSpec& spec) {
  ORBWEAVE_RETURN_IF_ERROR(CheckLength("kind, in bytes,", spec.kind.size(), 64));
  ORBWEAVE_RETURN_IF_ERROR(CheckLength("label, in bytes,", spec.label.size(), 1024));
  ORBWEAVE_RETURN_IF_ERROR(CheckLength("options, in bytes,", spec.options_text.size(), 16 * 1024));
  return CheckLength("inputs", spec.inputs.size(), 64);
}

}  // namespace orbweave
