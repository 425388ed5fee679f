// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <mutex>
#include <string>

#include "core/pipeline/blob_access.h"

namespace orbweave::testing {

/// Blobs in memory. Thread-safe.
class MemoryBlobs final : public BlobAccess {
 public:
  absl::StatusOr<std::string> Get(const Digest& digest) override {
    const std::lock_guard lock(mutex_);
    const auto found = blobs_.find(digest);
    if (found == blobs_.end()) return absl::NotFoundError("no such blob");
    return found->second;
  }
  absl::StatusOr<Digest> Put(std::string_view bytes) override {
    const std::lock_guard lock(mutex_);
    const Digest digest = DigestOf(bytes);
    blobs_[digest] = bytes;
    return digest;
  }

 private:
  std::mutex mutex_;
  std::map<Digest, std::string> blobs_;
};

}  // namespace orbweave::testing
