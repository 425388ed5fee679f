// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/status.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/blob_grant.h"

namespace orbweave {

struct ObjectInfo {
  std::string key{};
  uint64_t size_bytes = 0;
  int64_t modified_unix_s = 0;
  std::string etag{};  ///< what changes with its bytes, as the store says it; empty: it does not
};

/// Bytes number `first` to `last` of an object.
struct ByteRange {
  uint64_t first = 0;
  uint64_t last = 0;
};

/// Named objects somewhere else; a key is relative to the store. Thread-safe. Codes common to all:
/// Unavailable: try again later (asked a few times already). PermissionDenied,
/// FailedPrecondition: the store is not set up for this, and why.
class ObjectStore {
 public:
  virtual ~ObjectStore() = default;
  /// NotFound: there is none. Its key and ETag are left empty.
  [[nodiscard]] virtual absl::StatusOr<ObjectInfo> Head(const std::string& key) = 0;
  /// In pieces; not verified. NotFound: there is none. OutOfRange: it is shorter.
  [[nodiscard]] virtual absl::Status Get(const std::string& key,
                                         const std::optional<ByteRange>& range,
                                         const TakePiece& take) = 0;
  /// Stores `bytes`, whose digest is `digest`, unless there is such a key. DataLoss: they have
  /// another digest.
  [[nodiscard]] virtual absl::Status Put(const std::string& key,
                                         const Digest& digest,
                                         std::string_view bytes) = 0;
  /// Also OK when there is none.
  [[nodiscard]] virtual absl::Status Delete(const std::string& key) = 0;
  /// All objects, by key.
  [[nodiscard]] virtual absl::StatusOr<std::vector<ObjectInfo>> List() = 0;

  /// The right to read an object, from now on.
  [[nodiscard]] virtual ObjectGrant GrantGet(const std::string& key, int valid_s) = 0;
  /// The right to store an object of these bytes, and no others, unless there is such a key.
  [[nodiscard]] virtual ObjectGrant GrantPut(const std::string& key,
                                             const Digest& digest,
                                             uint64_t size_bytes,
                                             int valid_s) = 0;
};

}  // namespace orbweave
