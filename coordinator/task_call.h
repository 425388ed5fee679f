// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "coordinator/dispatcher.h"
#include "coordinator/served_api.h"

namespace orbweave {

/// Who asks for a task, and for how long.
struct TaskRequest {
  uint64_t session = 0;
  uint32_t slot = 0;
  double until_s = 0.0;    ///< by the coordinator's clock
  std::stop_token left{};  ///< nobody waits any more
};

/// A question for a task that is to be answered. It is destroyed without the coordinator's lock,
/// which `on_left` may be waiting for.
struct TaskCall {
  TaskRequest request{};
  TakeLease take{};
  std::optional<std::stop_callback<std::function<void()>>> on_left{};
};

/// What came of a question: a task that is to be written down and handed out, nothing, or why there
/// is none.
struct TaskAnswer {
  std::shared_ptr<TaskCall> call{};
  absl::StatusOr<std::optional<Grant>> grant{std::nullopt};
};

}  // namespace orbweave
