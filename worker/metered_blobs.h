// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>

#include "core/pipeline/blob_access.h"

namespace orbweave {

/// The blobs of another, with the bytes that were got and put counted; what failed counts nothing.
/// Thread-safe.
class MeteredBlobs final : public BlobAccess {
 public:
  explicit MeteredBlobs(BlobAccess& blobs) : blobs_(blobs) {}

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;

  [[nodiscard]] uint64_t bytes_in() const { return bytes_in_; }
  [[nodiscard]] uint64_t bytes_out() const { return bytes_out_; }

 private:
  BlobAccess& blobs_;
  std::atomic<uint64_t> bytes_in_{0};
  std::atomic<uint64_t> bytes_out_{0};
};

}  // namespace orbweave
