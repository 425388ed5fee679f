// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <stop_token>

#include "core/pipeline/blob_access.h"
#include "worker/shared_bytes.h"

namespace orbweave {

/// Blobs of `source` with the last used ones kept in memory, up to `capacity_bytes`. Waits through
/// times when the source is Unavailable, until `stop`. Thread-safe.
class BlobCache {
 public:
  BlobCache(BlobAccess& source, size_t capacity_bytes, std::stop_token stop)
      : source_(source), capacity_bytes_(capacity_bytes), stop_(std::move(stop)) {}

  /// Errors of both: those of the source.
  [[nodiscard]] absl::StatusOr<SharedBytes> Get(const Digest& digest);
  /// `digest` is that of `bytes`.
  [[nodiscard]] absl::Status Put(const Digest& digest, const SharedBytes& bytes);

 private:
  using Entry = std::pair<Digest, SharedBytes>;
  void Keep(const Digest& digest, const SharedBytes& bytes);

  BlobAccess& source_;
  size_t capacity_bytes_;
  std::stop_token stop_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< last used first
  std::map<Digest, std::list<Entry>::iterator> places_;
  size_t size_bytes_ = 0;
};

}  // namespace orbweave
