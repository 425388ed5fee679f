// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "core/base/status.h"

namespace orbweave {

/// The number under which a child finds the descriptor it was given.
inline constexpr int kChannelDescriptor = 3;

struct ChildSettings {
  std::string
      log_path{};    ///< takes stdout and stderr, appended; empty: both go where our stderr goes
  int channel = -1;  ///< a descriptor of ours that becomes kChannelDescriptor; -1: none
};

/// A process started from this one by posix_spawn (never a bare fork: threads are running).
/// Destroying it kills and reaps it.
class ChildProcess {
 public:
  ChildProcess() = default;
  ~ChildProcess();
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;

  /// Runs this very executable with `arguments` (beginning with its name) in a process group of its
  /// own (Ctrl-C does not reach it), stdin empty, with no descriptor of ours but those of
  /// `settings`.
  [[nodiscard]] static absl::StatusOr<ChildProcess> SpawnSelf(
      const std::vector<std::string>& arguments, const ChildSettings& settings);

  [[nodiscard]] bool IsRunning() const { return pid_ > 0; }
  [[nodiscard]] pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  /// The processor time it has used; 0 when it is gone.
  [[nodiscard]] double CpuSeconds() const;
  /// How it ended ("exit code 1", "signal 9 (Killed)"), once; nullopt while it runs.
  [[nodiscard]] std::optional<std::string> PollEnd();
  /// Ends it, unless it has ended by itself; how it ended, once.
  std::string Kill();

 private:
  pid_t pid_ = -1;
};

}  // namespace orbweave
