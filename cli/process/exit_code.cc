// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "cli/process/exit_code.h"

#include <cstdio>
#include <string>

#include "absl/strings/cord.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

/// They mark errors that a code alone does not tell from others.
constexpr const char* kVerdictPayload = "orbweave/verdict";
constexpr const char* kStoppedPayload = "orbweave/stopped";

absl::Status Mark(absl::Status status, const char* payload) {
  status.SetPayload(payload, absl::Cord());
  return status;
}

}  // namespace

absl::Status VerdictError(const std::string& message) {
  return Mark(absl::FailedPreconditionError(message), kVerdictPayload);
}

absl::Status StoppedError(const std::string& message) {
  return Mark(absl::CancelledError(message), kStoppedPayload);
}

int ExitCodeOf(const absl::Status& status) {
  if (status.GetPayload(kVerdictPayload).has_value()) return kExitVerdict;
  if (status.GetPayload(kStoppedPayload).has_value()) return kExitStopped;
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
