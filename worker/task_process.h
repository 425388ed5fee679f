// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/base/clock.h"
#include "orbweave/v1/task_process.pb.h"
#include "worker/child_process.h"
#include "worker/message_channel.h"
#include "worker/task_executor.h"
#include "worker/task_watch.h"

namespace orbweave {

/// Runs tasks in a process of their own, so that a crash, an endless loop or a lack of memory ends
/// an attempt and not the worker. The process is this executable again (`<self> exec-tasks`), which
/// calls ServeTasks; it is started with the first task, stays for the next ones, and is replaced
/// when it died. It reaches blobs only through this object, and dies with the thread that started
/// it.
class TaskProcess final : public TaskExecutor {
 public:
  TaskProcess(const TaskLimits& limits, const Clock& clock) : limits_(limits), clock_(clock) {}

  /// Aborted: the process died in the middle of the task; the message says of what.
  /// DeadlineExceeded: it was killed because the task hung, spun or took too long. Unavailable: no
  /// process could be started.
  [[nodiscard]] absl::StatusOr<TaskResult> Run(const TaskSpec& spec,
                                               TaskBlobs& blobs,
                                               const StageContext& context) override;

 private:
  [[nodiscard]] absl::Status EnsureStarted();
  [[nodiscard]] absl::Status Send(const v1::ToTaskProcess& message, const SharedBytes& bulk = {});
  /// What the process says at the end of the task. Errors: the process is of no use any more.
  [[nodiscard]] absl::StatusOr<v1::TaskEnd> Attend(const TaskSpec& spec,
                                                   TaskBlobs& blobs,
                                                   const StageContext& context);
  /// Takes one message; the last one of a task is returned.
  [[nodiscard]] absl::StatusOr<std::optional<v1::TaskEnd>> ReceiveOne(TaskBlobs& blobs,
                                                                      const StageContext& context);
  [[nodiscard]] absl::Status AnswerGet(const std::string& digest, TaskBlobs& blobs);
  /// Ends the process; how it ended.
  std::string EndProcess();

  TaskLimits limits_;
  const Clock& clock_;
  ChildProcess process_;
  std::optional<MessageChannel> channel_;
};

}  // namespace orbweave
