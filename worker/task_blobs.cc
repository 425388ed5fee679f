// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/task_blobs.h"

#include <algorithm>
#include <utility>

namespace orbweave {

absl::StatusOr<SharedBytes> TaskBlobs::Get(const Digest& digest) {
  while (std::ranges::find(on_their_way_, digest, &OnItsWay::digest) != on_their_way_.end())
    AwaitOldest();
  return blobs_.Get(digest);
}

void TaskBlobs::Put(const Digest& digest, SharedBytes bytes) {
  if (on_their_way_.size() == kMostOnTheirWay) AwaitOldest();
  // Where the system gives no more threads, the one that waits for it stores it.
  constexpr auto kPolicy = std::launch::async | std::launch::deferred;
  on_their_way_.push_back({digest, std::async(kPolicy, [this, digest, bytes = std::move(bytes)] {
                             return blobs_.Put(digest, bytes);
                           })});
}

absl::Status TaskBlobs::Settle() {
  while (!on_their_way_.empty()) AwaitOldest();
  return first_error_;
}

void TaskBlobs::AwaitOldest() {
  const absl::Status stored = on_their_way_.front().stored.get();
  on_their_way_.pop_front();
  if (first_error_.ok()) first_error_ = stored;
}

}  // namespace orbweave
