// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <future>

#include "worker/blob_cache.h"

namespace orbweave {

/// What one task reads and leaves. What it leaves is stored while the task goes on, a few blobs at
/// a time: a store spends its time waiting for its disk, and waits for several as long as for one.
/// Of one thread.
class TaskBlobs {
 public:
  /// Blobs on their way to the store; the next one waits until the oldest is there.
  static constexpr size_t kMostOnTheirWay = 8;

  /// `blobs` outlives it.
  explicit TaskBlobs(BlobCache& blobs) : blobs_(blobs) {}

  /// As BlobCache::Get; also what this task put.
  [[nodiscard]] absl::StatusOr<SharedBytes> Get(const Digest& digest);
  /// Begins to store `bytes`, whose digest is `digest`. Whether they are stored, Settle tells.
  void Put(const Digest& digest, SharedBytes bytes);
  /// Waits until all that was put is stored. Errors: the first, in the order of putting, of
  /// BlobCache::Put; then not all is stored.
  [[nodiscard]] absl::Status Settle();

 private:
  struct OnItsWay {
    Digest digest{};
    std::future<absl::Status> stored{};
  };
  void AwaitOldest();

  BlobCache& blobs_;
  std::deque<OnItsWay> on_their_way_;  ///< oldest first; gone only when they have arrived
  absl::Status first_error_;
};

}  // namespace orbweave
