// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/status.h"

namespace orbweave {

/// A process started from this one by posix_spawn (never a bare fork: threads are running).
/// Destroying it kills and reaps it.
class ChildProcess {
 public:
  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;

  /// Runs this very executable with `arguments` (beginning with its name) in a process group of its
  /// own (Ctrl-C does not reach it), stdin empty, stdout and stderr appended to `log_path`.
  [[nodiscard]] static absl::StatusOr<ChildProcess> SpawnSelf(
      const std::vector<std::string>& arguments, const std::string& log_path);

  [[nodiscard]] bool IsRunning() const { return pid_ > 0; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  /// How it ended ("exit code 1", "signal 9"), once; nullopt while it runs.
  [[nodiscard]] std::optional<std::string> PollEnd();

 private:
  pid_t pid_ = -1;
};

}  // namespace orbweave
