// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline/blob_depot.h"

namespace orbweave {

/// Bytes of blobs that were put and got.
struct BlobTraffic {
  uint64_t bytes_in = 0;
  uint64_t bytes_out = 0;
};

/// A file of the store.
struct StoredBlob {
  Digest digest{};
  uint64_t size_bytes = 0;  ///< 0: the bytes are in a file outside
};

/// Blobs in a folder: `<folder>/ab/<hex>` holds the bytes, `<folder>/links/<hex>` the absolute path
/// of a file outside that holds them (or another place, see NotePlace). A blob is written once and
/// whole. Every read is verified; a blob that is not what its name says is removed, so that it can
/// be made again, or replaced when it is put again. The time of its file says when it was last put
/// or used. Thread-safe; one process has the folder, others, also on other machines, may share it.
class BlobStore final : public BlobDepot {
 public:
  /// Has the folder, which is made when there is none. What others are writing there is removed;
  /// they find out (Unavailable) and write it again.
  [[nodiscard]] static absl::StatusOr<BlobStore> Open(const std::string& folder);
  /// Shares the folder that another process has. Its links are not followed: the files they name
  /// are on the machine of that process. NotFound: `folder` is not the folder of a store.
  [[nodiscard]] static absl::StatusOr<BlobStore> Share(const std::string& folder);

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

  /// Whether the blob, or the file it links to, is there; its bytes are not looked at.
  [[nodiscard]] bool Has(const Digest& digest) const;
  /// Has; and if so, it counts as used now.
  [[nodiscard]] bool Use(const Digest& digest) const;
  /// Whether it is there and its bytes are right (otherwise it is removed).
  [[nodiscard]] bool Verify(const Digest& digest);
  /// Those that are there count as used now.
  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  /// InvalidArgument: the path is not absolute.
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;
  /// Notes that the blob is to be found at `place`, which is no file: it counts as none here, but
  /// is listed, used and removed like a link.
  [[nodiscard]] absl::Status NotePlace(const Digest& digest, const std::string& place);
  /// Where a link leads, or the place that was noted; empty: neither.
  [[nodiscard]] std::string LinkOf(const Digest& digest) const;

  /// All blobs, by digest. Unavailable, PermissionDenied: the folder cannot be read.
  [[nodiscard]] absl::StatusOr<std::vector<StoredBlob>> List() const;
  /// Whether nobody put or used the blob within the last `unused_s` seconds.
  [[nodiscard]] bool IsUnused(const Digest& digest, double unused_s) const;
  /// Removes the blob if it is unused; whether it was.
  [[nodiscard]] bool RemoveUnused(const Digest& digest, double unused_s);

 private:
  BlobStore(std::string folder, bool follows_links)
      : folder_(std::move(folder)), follows_links_(follows_links) {}
  [[nodiscard]] std::string BlobPath(const Digest& digest) const;
  [[nodiscard]] std::string LinkPath(const Digest& digest) const;
  [[nodiscard]] std::string ScratchDir() const { return folder_ + "/tmp"; }
  /// The error of a blob that is not there, with the name of the file that it was.
  [[nodiscard]] absl::Status NotStored(const Digest& digest) const;
  /// The file that holds the blob's bytes, whether ours or linked; empty when there is none.
  [[nodiscard]] std::string FileOf(const Digest& digest) const;
  void Forget(const Digest& digest) const;

  [[nodiscard]] bool RemoveFileUnused(const std::string& path, double unused_s);

  std::string folder_;
  bool follows_links_ = true;
};

}  // namespace orbweave
