// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// What a command says when its coordinator does not answer: Unavailable is told with the address.
[[nodiscard]] inline absl::Status NameCoordinator(const absl::Status& status,
                                                  const std::string& address) {
  if (!absl::IsUnavailable(status)) return status;
  return Annotate(status, "no coordinator answers at " + address);
}

}  // namespace orbweave
