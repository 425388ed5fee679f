// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

#include "core/pipeline/blob_access.h"

namespace orbweave {

/// Blobs of `source` with those that were read last kept as files of a disk of this machine, up to
/// `capacity_bytes`: what is read again does not come over the network again. Nothing of it is
/// needed by anybody else, and it goes with this object; so nothing is flushed. A disk that is full
/// or broken costs what is kept, not the reading. Thread-safe.
class ScratchTier final : public BlobAccess {
 public:
  /// Makes a folder of its own in `folder`, which is made too. PermissionDenied, Unavailable: it
  /// cannot, and why. `source` outlives it.
  [[nodiscard]] static absl::StatusOr<std::unique_ptr<ScratchTier>> Make(BlobAccess& source,
                                                                         const std::string& folder,
                                                                         uint64_t capacity_bytes);
  ~ScratchTier() override;
  ScratchTier(const ScratchTier&) = delete;
  ScratchTier& operator=(const ScratchTier&) = delete;

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  /// Past the disk, as Write.
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  /// Unavailable also: the file was damaged; it is no more, and the next time the source is asked.
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

 private:
  struct Kept {
    Digest digest{};
    uint64_t size_bytes = 0;
  };

  ScratchTier(BlobAccess& source, std::string folder, uint64_t capacity_bytes)
      : source_(source), folder_(std::move(folder)), capacity_bytes_(capacity_bytes) {}
  [[nodiscard]] std::string PathOf(const Digest& digest) const;
  /// The open file of a blob that is kept, which now counts as used last; negative: it is not.
  [[nodiscard]] int Open(const Digest& digest);
  /// NotFound: it is not kept.
  [[nodiscard]] absl::Status ReadKept(const Digest& digest, const TakePiece& take);
  /// The finished file `from` becomes the blob's, and others go for which there is no more room.
  void Keep(const Digest& digest, uint64_t size_bytes, const std::string& from);
  void Drop(const Digest& digest);

  BlobAccess& source_;
  const std::string folder_;
  const uint64_t capacity_bytes_;
  std::mutex mutex_;
  std::list<Kept> kept_;  ///< last used first
  std::unordered_map<Digest, std::list<Kept>::iterator> places_;
  uint64_t size_bytes_ = 0;
  uint64_t files_ = 0;  ///< that were begun: names of those that are not finished
};

}  // namespace orbweave
