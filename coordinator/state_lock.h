// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"

namespace orbweave {

/// Holds a state folder for one coordinator: flock on `<folder>/lock` until destroyed. The system
/// frees it when the process dies, however it dies.
class StateLock {
 public:
  StateLock() = default;
  ~StateLock();
  StateLock(StateLock&& other) noexcept;
  StateLock& operator=(StateLock&& other) noexcept;

  /// FailedPrecondition: another coordinator holds the folder.
  [[nodiscard]] static absl::StatusOr<StateLock> Acquire(const std::string& folder);

 private:
  int fd_ = -1;
};

}  // namespace orbweave
