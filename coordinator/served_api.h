// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <functional>
#include <optional>
#include <stop_token>

#include "core/pipeline/coordinator_api.h"

namespace orbweave {

/// Told the answer to a question for a task, once.
using TakeLease = std::function<void(absl::StatusOr<std::optional<Lease>> answer)>;

/// A coordinator that can be served without a thread for each worker that waits.
class ServedApi : public CoordinatorApi {
 public:
  /// LeaseTask that does not wait: `take` is told its answer, at once or from another thread, which
  /// it must not keep for long.
  virtual void AskForTask(uint64_t session,
                          uint32_t slot,
                          double wait_s,
                          const std::stop_token& left,
                          TakeLease take) = 0;
};

}  // namespace orbweave
