// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>

#include "core/pipeline/blob_access.h"

namespace orbweave {

/// Blobs of `source` with the last used ones kept in memory, up to `capacity_bytes`. Waits through
/// times when the source is Unavailable, until `stop`. Thread-safe.
class BlobCache final : public BlobAccess {
 public:
  BlobCache(BlobAccess& source, size_t capacity_bytes, std::stop_token stop)
      : source_(source), capacity_bytes_(capacity_bytes), stop_(std::move(stop)) {}

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;

 private:
  using Entry = std::pair<Digest, std::string>;
  void Keep(const Digest& digest, std::string_view bytes);

  BlobAccess& source_;
  size_t capacity_bytes_;
  std::stop_token stop_;
  std::mutex mutex_;
  std::list<Entry> entries_;  ///< last used first
  std::map<Digest, std::list<Entry>::iterator> places_;
  size_t size_bytes_ = 0;
};

}  // namespace orbweave
