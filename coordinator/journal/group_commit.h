// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <vector>

#include "core/base/status.h"

namespace orbweave {

/// Lets threads that wait for the disk share a transaction: while one is committed, the writes that
/// come gather, and go together in the next. Thread-safe.
class GroupCommit {
 public:
  using Write = std::function<absl::Status()>;
  /// Runs all writes in one transaction. Called by one thread at a time.
  using Transact = std::function<absl::Status(const std::vector<const Write*>& writes)>;

  explicit GroupCommit(Transact transact) : transact_(std::move(transact)) {}

  /// Returns what became of the transaction that `write` was in; all its writes share their fate.
  [[nodiscard]] absl::Status Commit(const Write& write);

 private:
  struct Waiter {
    const Write* write = nullptr;
    bool done = false;
    absl::Status status{};
  };
  /// With the lock: commits what has gathered.
  void Lead(std::unique_lock<std::mutex>& lock);

  Transact transact_;
  std::mutex mutex_;
  std::condition_variable finished_;
  std::vector<Waiter*> gathered_;
  bool is_committing_ = false;
};

}  // namespace orbweave
