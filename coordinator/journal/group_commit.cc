// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/journal/group_commit.h"

#include <utility>

namespace orbweave {

absl::Status GroupCommit::Commit(const Write& write) {
  Waiter self{.write = &write};
  std::unique_lock lock(mutex_);
  gathered_.push_back(&self);
  finished_.wait(lock, [&] { return self.done || !is_committing_; });
  if (!self.done) Lead(lock);
  return self.status;
}

void GroupCommit::Lead(std::unique_lock<std::mutex>& lock) {
  const std::vector<Waiter*> batch = std::exchange(gathered_, {});
  is_committing_ = true;
  lock.unlock();
  std::vector<const Write*> writes;
  for (const Waiter* waiter : batch) writes.push_back(waiter->write);
  const absl::Status status = transact_(writes);
  lock.lock();
  is_committing_ = false;
  for (Waiter* waiter : batch) {
    waiter->status = status;
    waiter->done = true;
  }
  finished_.notify_all();
}

}  // namespace orbweave
