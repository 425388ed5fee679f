// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "absl/status/status.h"

namespace orbweave {

/// What LeaseTask says, as Cancelled, to a worker that is drained.
inline constexpr char kIsToLeave[] = "the worker is to leave";

/// Whether it says so. A server that ends cancels its calls as well, in other words: that is no
/// reason to leave.
[[nodiscard]] inline bool IsToLeave(const absl::Status& status) {
  return absl::IsCancelled(status) && status.message() == kIsToLeave;
}

}  // namespace orbweave
