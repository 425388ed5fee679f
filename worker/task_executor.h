// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>

#include "core/base/stage_context.h"
#include "core/pipeline/task.h"
#include "worker/task_blobs.h"

namespace orbweave {

/// Runs the tasks of one slot of a worker, one after another.
class TaskExecutor {
 public:
  virtual ~TaskExecutor() = default;
  /// Runs a task and measures it; its blobs are those of `blobs`, where what the task left may
  /// still be on its way. Errors: those of the stage; Cancelled once `context.stop` is requested.
  [[nodiscard]] virtual absl::StatusOr<TaskResult> Run(const TaskSpec& spec,
                                                       TaskBlobs& blobs,
                                                       const StageContext& context) = 0;
};

/// Called once by each slot.
using MakeTaskExecutor = std::function<std::unique_ptr<TaskExecutor>()>;

}  // namespace orbweave
