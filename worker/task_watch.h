// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace orbweave {

/// What a task may take.
struct TaskLimits {
  double stall_s = 600.0;     ///< without a sign of life: it hangs or spins; see TaskWatch
  double total_s = 21'600.0;  ///< no task runs longer
  double stop_grace_s = 5.0;  ///< between the wish that it stops and the end of its process
  uint64_t memory_bytes = 0;  ///< of its process; 0: what the machine has
};

/// Tells a task that works from one that hangs and one that spins. Signs of life are progress, the
/// use of blobs and StageContext::CheckStop. After `stall_s` without one, a task hangs when its
/// process used less processor time meanwhile than 1 % of `stall_s`, and spins once it used
/// `stall_s` of it: a slow or crowded machine buys it time. Pure: time is handed in.
class TaskWatch {
 public:
  /// The task begins; `cpu_s` is the processor time its process has used before.
  TaskWatch(const TaskLimits& limits, double now_s, double cpu_s)
      : limits_(limits), begin_s_(now_s), sign_{now_s, cpu_s}, busy_{now_s, cpu_s} {}

  void SawSign(double now_s, double cpu_s) { sign_ = busy_ = {now_s, cpu_s}; }
  /// Why the task is to be given up; nothing while it may go on.
  [[nodiscard]] std::optional<std::string> Look(double now_s, double cpu_s);
  /// Until the next look.
  [[nodiscard]] double Wait() const;

 private:
  struct Moment {
    double now_s = 0.0;
    double cpu_s = 0.0;
  };

  TaskLimits limits_;
  double begin_s_;
  Moment sign_;  ///< the last sign of life
  Moment busy_;  ///< when it was last seen to use the processor
};

}  // namespace orbweave
