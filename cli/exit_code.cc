// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/exit_code.h"

#include <cstdio>
#include <string>

#include "absl/strings/cord.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

/// Marks an error that a code alone does not tell from others.
constexpr const char* kVerdictPayload = "orbweave/verdict";

}  // namespace

absl::Status VerdictError(const std::string& message) {
  absl::Status status = absl::FailedPreconditionError(message);
  status.SetPayload(kVerdictPayload, absl::Cord());
  return status;
}

int ExitCodeOf(const absl::Status& status) {
  if (status.GetPayload(kVerdictPayload).has_value()) return kExitVerdict;
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return kExitOk;
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kAlreadyExists:
    case absl::StatusCode::kPermissionDenied:
    case absl::StatusCode::kUnauthenticated:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kOutOfRange:
      return kExitUsage;
    case absl::StatusCode::kUnavailable:
      return kExitUnavailable;
    case absl::StatusCode::kCancelled:
      return kExitInterrupted;
    default:
      return kExitFailed;
  }
}

int ReportStatus(const absl::Status& status) {
  if (!status.ok()) {
    const std::string text =
        PrintableText({status.message().data(), status.message().size()}, "\n");
    std::fprintf(stderr, "orbweave: %s\n", text.c_str());
  }
  return ExitCodeOf(status);
}

}  // namespace orbweave
