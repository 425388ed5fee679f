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

/// An object that comes in parts.
struct UploadInfo {
  std::string key{};
  std::string upload{};
  int64_t begun_unix_s = 0;
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

  /// Begins an object that comes in parts; the server's name for what is coming.
  [[nodiscard]] virtual absl::StatusOr<std::string> BeginUpload(const std::string& key) = 0;
  /// The right to store one part of it, of these bytes and no others.
  [[nodiscard]] virtual ObjectGrant GrantPart(const std::string& key,
                                              const ObjectPart& part,
                                              int valid_s) = 0;
  /// Makes the object of all its parts, whose tags are in order; OK also when there is such a key.
  /// NotFound: there is no such upload, or not any more.
  [[nodiscard]] virtual absl::Status FinishUpload(const std::string& key,
                                                  const std::string& upload,
                                                  const std::vector<std::string>& etags) = 0;
  /// Gives up what has come of it; also OK when there is none.
  [[nodiscard]] virtual absl::Status AbortUpload(const std::string& key,
                                                 const std::string& upload) = 0;
  /// Uploads that were begun and not ended, a thousand at most.
  [[nodiscard]] virtual absl::StatusOr<std::vector<UploadInfo>> ListUploads() = 0;
};

}  // namespace orbweave
