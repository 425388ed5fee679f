// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <grpcpp/support/status.h>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {

/// The codes are the same numbers; a deadline that passed is a connection that broke, and a server
/// whose threads are all at work is one to come back to.
[[nodiscard]] inline absl::Status FromWire(const grpc::Status& status) {
  if (status.ok()) return absl::OkStatus();
  constexpr char kAllThreadsBusy[] = "Server Threadpool Exhausted";  // gRPC's own words
  if (status.error_message() == kAllThreadsBusy)
    return absl::UnavailableError("the coordinator has no thread free for this call");
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) {
    return absl::UnavailableError(
        absl::StrCat("the coordinator did not answer: ", status.error_message()));
  }
  return {static_cast<absl::StatusCode>(status.error_code()), status.error_message()};
}

}  // namespace orbweave
