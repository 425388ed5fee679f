// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/pipeline/blob_access.h"
#include "core/storage/blob_store.h"
#include "objects/object_store.h"
#include "security/unix_time.h"

namespace orbweave {

/// The large blobs of a coordinator, each an object of a store that no other coordinator uses,
/// whose key is the blob's digest. What is there is known without asking: from a list that is read
/// at the start and whenever it is Refreshed, and from what is confirmed since. When a blob was
/// last used is the time of its object or, later, what this process remembers. Thread-safe.
class ObjectShelf {
 public:
  /// `owner` names the coordinator's state: a store that another one has is FailedPrecondition.
  /// Errors of the store.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<ObjectShelf>> Open(
      std::shared_ptr<ObjectStore> store, const std::string& owner, UnixClock clock = UnixNow);

  /// Whether it is known to be there.
  [[nodiscard]] bool Has(const Digest& digest);
  /// Has; and if so, it counts as used now.
  [[nodiscard]] bool Use(const Digest& digest);
  /// The same, and asks the store for one that is not known. Unavailable also: it is being removed.
  [[nodiscard]] absl::StatusOr<bool> Confirm(const Digest& digest);
  /// As BlobAccess::Read. One that is gone or damaged is known no more, and removed.
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take);
  /// The right to read it; nothing: it is not there.
  [[nodiscard]] std::optional<ObjectGrant> GrantGet(const Digest& digest, int valid_s);
  /// The right to write it. Unavailable: it is being removed.
  [[nodiscard]] absl::StatusOr<ObjectGrant> GrantPut(const Digest& digest,
                                                     uint64_t size_bytes,
                                                     int valid_s);

  /// An object that comes in parts: its name for FinishUpload. Unavailable: it is being removed.
  [[nodiscard]] absl::StatusOr<std::string> BeginUpload(const Digest& digest);
  [[nodiscard]] ObjectGrant GrantPart(const Digest& digest, const ObjectPart& part, int valid_s);
  /// Makes the object of its parts, or calls it off. Errors of ObjectStore::FinishUpload.
  [[nodiscard]] absl::Status FinishUpload(const UploadEnd& end);
  /// Calls off uploads that were begun `unused_s` ago or earlier; servers keep, and charge for,
  /// what has come of them.
  [[nodiscard]] absl::Status AbortUploads(double unused_s);

  /// Reads the list of the store, unless that was done within the last `most_age_s` seconds.
  [[nodiscard]] absl::Status Refresh(int64_t most_age_s = 0);
  [[nodiscard]] std::vector<StoredBlob> List();
  /// Whether nobody put or used the blob within the last `unused_s` seconds, or it is not there.
  [[nodiscard]] bool IsUnused(const Digest& digest, double unused_s);
  /// Removes the blob if it is unused; whether it was.
  [[nodiscard]] absl::StatusOr<bool> RemoveUnused(const Digest& digest, double unused_s);
  /// OK when `bytes` can be put and read; they stay there until the next probe. One at a time.
  [[nodiscard]] absl::Status Probe(std::string_view bytes);

 private:
  struct Entry {
    uint64_t size_bytes = 0;
    int64_t used_unix_s = 0;
    uint64_t noted = 0;  ///< number of the list before which it was found
    bool is_leaving = false;
  };

  ObjectShelf(std::shared_ptr<ObjectStore> store, UnixClock clock)
      : store_(std::move(store)), clock_(std::move(clock)) {}
  [[nodiscard]] absl::Status Claim(const std::string& owner);
  [[nodiscard]] absl::StatusOr<std::string> ReadOwner();
  [[nodiscard]] bool BeginToRemove(const Digest& digest, double unused_s);
  void Forget(const Digest& digest);

  const std::shared_ptr<ObjectStore> store_;
  const UnixClock clock_;
  std::mutex mutex_;
  std::unordered_map<Digest, Entry> entries_;
  uint64_t lists_ = 0;         ///< that were begun
  int64_t listed_unix_s_ = 0;  ///< the last one that was read
};

}  // namespace orbweave
