// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coordinator/object_roots.h"
#include "coordinator/object_shelf.h"
#include "core/pipeline/blob_grant.h"
#include "core/storage/blob_store.h"

namespace orbweave {

/// Where a coordinator with this state folder keeps its blobs.
[[nodiscard]] std::string BlobFolderOf(const std::string& state_dir);

/// The blobs of a coordinator: in its folder and, where it has an object store, the large ones that
/// others put there by its grants; and objects beneath its roots, which are another's, by links to
/// them. Thread-safe.
class KeptBlobs final : public BlobDepot {
 public:
  /// `objects`: null for none. Errors of BlobStore::Open and ObjectShelf::Open.
  [[nodiscard]] static absl::StatusOr<KeptBlobs> Open(const std::string& state_dir,
                                                      std::shared_ptr<ObjectStore> objects,
                                                      ObjectRoots roots = {},
                                                      ObjectLimits limits = {});

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  /// Into the folder, as Write does.
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  /// A linked object that is gone, or has other bytes by now, is NotFound, with its name; the link
  /// stays, so that what is put back is found.
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;
  /// Not of linked objects, which may have gone: who brings them links them again, or their bytes.
  [[nodiscard]] absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) override;
  /// Also of an object s3://bucket/key beneath a root, of which only is looked that it can be read:
  /// NotFound, PermissionDenied, Unavailable.
  [[nodiscard]] absl::Status LinkFile(const Digest& digest, const std::string& path) override;

  /// As GrantBlobs of ServedApi.
  [[nodiscard]] absl::StatusOr<std::vector<BlobGrant>> Grant(const std::vector<WantedBlob>& blobs,
                                                             GrantVerb verb,
                                                             int valid_s);

  /// As FinishUpload of ServedApi.
  [[nodiscard]] absl::Status FinishUpload(const UploadEnd& end);
  /// See ObjectShelf::AbortUploads.
  [[nodiscard]] absl::Status AbortUploads(double unused_s);

  /// Whether it is known to be there.
  [[nodiscard]] bool Has(const Digest& digest);
  /// Has; and if so, it counts as used now.
  [[nodiscard]] bool Use(const Digest& digest);
  /// The same of one that was put just now: the object store is asked where it is not known.
  [[nodiscard]] absl::StatusOr<bool> Confirm(const Digest& digest);
  /// Whether it is there; its bytes are looked at in the folder (see BlobStore), not in an object
  /// store: they are held against their digest when they come.
  [[nodiscard]] bool Verify(const Digest& digest);
  /// Looks again what the object store has, once in five minutes at most, and after
  /// something was found to be gone.
  [[nodiscard]] absl::Status Refresh();
  /// All blobs, by digest. Errors of both.
  [[nodiscard]] absl::StatusOr<std::vector<StoredBlob>> List();
  [[nodiscard]] bool IsUnused(const Digest& digest, double unused_s);
  [[nodiscard]] absl::StatusOr<bool> RemoveUnused(const Digest& digest, double unused_s);
  /// OK when `bytes` can be put and read, in the folder and in the object store. One at a time.
  [[nodiscard]] absl::Status Probe(std::string_view bytes);

 private:
  KeptBlobs(BlobStore folder,
            std::unique_ptr<ObjectShelf> shelf,
            ObjectRoots roots,
            ObjectLimits limits)
      : folder_(std::move(folder)),
        shelf_(std::move(shelf)),
        roots_(std::move(roots)),
        limits_(limits) {}
  /// Use of one that is no linked object.
  [[nodiscard]] bool UseKept(const Digest& digest);
  /// The object that the blob is linked to; empty: none.
  [[nodiscard]] std::string LinkedObject(const Digest& digest) const;
  [[nodiscard]] absl::Status ReadObject(const Digest& digest,
                                        const std::string& path,
                                        const TakePiece& take);
  /// The right to read it, where the coordinator does not give it itself.
  [[nodiscard]] std::optional<ObjectGrant> GrantGet(const Digest& digest, int valid_s);
  [[nodiscard]] absl::StatusOr<BlobGrant> GrantOne(const WantedBlob& blob,
                                                   GrantVerb verb,
                                                   int valid_s);

  [[nodiscard]] absl::StatusOr<BlobGrant> GrantParts(const WantedBlob& blob);

  BlobStore folder_;
  std::unique_ptr<ObjectShelf> shelf_;  ///< null: no object store
  ObjectRoots roots_;
  ObjectLimits limits_;
};

}  // namespace orbweave
