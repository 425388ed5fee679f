// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/kept_blobs.h"

#include <map>
#include <optional>
#include <random>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/storage/durable_file.h"
#include "objects/s3_address.h"

namespace orbweave {
namespace {

/// What names the coordinator's state to others: random digits in a file, made once.
absl::StatusOr<std::string> NameOfState(const std::string& state_dir) {
  const std::string path = state_dir + "/store_owner";
  const absl::StatusOr<std::string> known = ReadWholeFile(path);
  if (!absl::IsNotFound(known.status())) return known;
  std::random_device device;
  const std::string name = absl::StrCat("orbweave coordinator ",
                                        absl::Hex(device()),
                                        absl::Hex(device()),
                                        absl::Hex(device()),
                                        absl::Hex(device()));
  ORBWEAVE_RETURN_IF_ERROR(WriteFileDurably(state_dir, path, name));
  return name;
}

}  // namespace

std::string BlobFolderOf(const std::string& state_dir) { return state_dir + "/blobs"; }

absl::StatusOr<KeptBlobs> KeptBlobs::Open(const std::string& state_dir,
                                          std::shared_ptr<ObjectStore> objects,
                                          ObjectRoots roots,
                                          ObjectLimits limits) {
  ORBWEAVE_ASSIGN_OR_RETURN(BlobStore folder, BlobStore::Open(BlobFolderOf(state_dir)));
  if (objects == nullptr) return KeptBlobs(std::move(folder), nullptr, std::move(roots), limits);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string owner, NameOfState(state_dir));
  ORBWEAVE_ASSIGN_OR_RETURN(std::unique_ptr<ObjectShelf> shelf,
                            ObjectShelf::Open(std::move(objects), owner));
  return KeptBlobs(std::move(folder), std::move(shelf), std::move(roots), limits);
}

absl::StatusOr<std::string> KeptBlobs::Get(const Digest& digest) {
  std::string bytes;
  ORBWEAVE_RETURN_IF_ERROR(Read(digest, [&bytes](std::string_view piece) {
    bytes += piece;
    return absl::OkStatus();
  }));
  return bytes;
}

absl::StatusOr<Digest> KeptBlobs::Put(std::string_view bytes) { return folder_.Put(bytes); }

absl::Status KeptBlobs::Read(const Digest& digest, const TakePiece& take) {
  // What is not there is noticed before the first piece.
  const absl::Status read = folder_.Read(digest, take);
  if (!absl::IsNotFound(read)) return read;
  if (shelf_ && shelf_->Has(digest)) return shelf_->Read(digest, take);
  const std::string linked = LinkedObject(digest);
  if (!linked.empty()) return ReadObject(digest, linked, take);
  return shelf_ ? shelf_->Read(digest, take) : read;
}

std::string KeptBlobs::LinkedObject(const Digest& digest) const {
  std::string linked = folder_.LinkOf(digest);
  return IsS3Address(linked) ? linked : std::string();
}

absl::Status KeptBlobs::ReadObject(const Digest& digest,
                                   const std::string& path,
                                   const TakePiece& take) {
  ORBWEAVE_ASSIGN_OR_RETURN(const RootedObject object, FindObject(roots_, path));
  DigestBuilder builder;
  const absl::Status read =
      object.store->Get(object.key, std::nullopt, [&](std::string_view piece) {
        builder.Add(piece);
        return take(piece);
      });
  const bool is_gone = absl::IsNotFound(read);
  if (!read.ok() && !is_gone) return read;
  if (read.ok() && builder.Finish() == digest) return absl::OkStatus();
  return absl::NotFoundError(absl::StrCat(
      path,
      is_gone ? " was removed" : " was changed",
      " after it was submitted: put it back as it was and `orbweave retry`, or submit again"));
}

absl::Status KeptBlobs::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  return folder_.Write(digest, size_bytes, next);
}

absl::StatusOr<std::vector<bool>> KeptBlobs::StatBlobs(const std::vector<Digest>& digests) {
  std::vector<bool> stored;
  for (const Digest& digest : digests) stored.push_back(UseKept(digest));
  return stored;
}

absl::Status KeptBlobs::LinkFile(const Digest& digest, const std::string& path) {
  if (!IsS3Address(path)) return folder_.LinkFile(digest, path);
  ORBWEAVE_ASSIGN_OR_RETURN(const RootedObject object, FindObject(roots_, path));
  const absl::Status seen = object.store->Head(object.key).status();
  if (absl::IsUnavailable(seen))
    return Annotate(seen, "the coordinator is here, but not the store of its root");
  ORBWEAVE_RETURN_IF_ERROR(seen);
  // What is here is held against the digest, an object that a client names is not.
  if (folder_.Has(digest)) return absl::OkStatus();
  return folder_.NotePlace(digest, path);
}

absl::StatusOr<std::vector<BlobGrant>> KeptBlobs::Grant(const std::vector<WantedBlob>& blobs,
                                                        GrantVerb verb,
                                                        int valid_s) {
  if (!shelf_ && roots_.empty()) return std::vector<BlobGrant>();
  if (blobs.size() > kMostGrants)
    return absl::InvalidArgumentError(absl::StrCat("grants for more than ", kMostGrants, " blobs"));
  std::vector<BlobGrant> grants;
  for (const WantedBlob& blob : blobs) {
    ORBWEAVE_ASSIGN_OR_RETURN(grants.emplace_back(), GrantOne(blob, verb, valid_s));
  }
  return grants;
}

absl::StatusOr<BlobGrant> KeptBlobs::GrantOne(const WantedBlob& blob, GrantVerb verb, int valid_s) {
  using Where = BlobGrant::Where;
  if (verb == GrantVerb::kGet) {
    const std::optional<ObjectGrant> grant = GrantGet(blob.digest, valid_s);
    return grant ? BlobGrant{Where::kObject, *grant} : BlobGrant{};
  }
  if (!shelf_) return BlobGrant{};
  if (verb == GrantVerb::kPutPart)
    return BlobGrant{Where::kObject, shelf_->GrantPart(blob.digest, blob.part, valid_s)};
  if (blob.size_bytes < kLeastObjectBytes) return BlobGrant{};
  if (UseKept(blob.digest)) return BlobGrant{.where = Where::kNowhere};
  if (blob.size_bytes > limits_.put_bytes) return GrantParts(blob);
  ORBWEAVE_ASSIGN_OR_RETURN(ObjectGrant grant,
                            shelf_->GrantPut(blob.digest, blob.size_bytes, valid_s));
  return BlobGrant{Where::kObject, std::move(grant)};
}

absl::StatusOr<BlobGrant> KeptBlobs::GrantParts(const WantedBlob& blob) {
  BlobGrant grant{.where = BlobGrant::Where::kParts,
                  .part_bytes = limits_.PartBytesOf(blob.size_bytes)};
  if (grant.part_bytes > kMostPutBytes)
    return absl::InvalidArgumentError("a blob that is larger than any object can be");
  ORBWEAVE_ASSIGN_OR_RETURN(grant.upload, shelf_->BeginUpload(blob.digest));
  return grant;
}

absl::Status KeptBlobs::FinishUpload(const UploadEnd& end) {
  if (!shelf_) return absl::FailedPreconditionError("this coordinator has no object store");
  return shelf_->FinishUpload(end);
}

absl::Status KeptBlobs::AbortUploads(double unused_s) {
  return shelf_ ? shelf_->AbortUploads(unused_s) : absl::OkStatus();
}

std::optional<ObjectGrant> KeptBlobs::GrantGet(const Digest& digest, int valid_s) {
  if (folder_.Has(digest)) return std::nullopt;
  if (shelf_) {
    if (std::optional<ObjectGrant> grant = shelf_->GrantGet(digest, valid_s)) return grant;
  }
  const absl::StatusOr<RootedObject> linked = FindObject(roots_, LinkedObject(digest));
  if (!linked.ok()) return std::nullopt;
  return linked->store->GrantGet(linked->key, valid_s);
}

bool KeptBlobs::Has(const Digest& digest) {
  return folder_.Has(digest) || (shelf_ && shelf_->Has(digest)) || !LinkedObject(digest).empty();
}

bool KeptBlobs::UseKept(const Digest& digest) {
  return folder_.Use(digest) || (shelf_ && shelf_->Use(digest));
}

bool KeptBlobs::Use(const Digest& digest) {
  return UseKept(digest) || !LinkedObject(digest).empty();
}

absl::StatusOr<bool> KeptBlobs::Confirm(const Digest& digest) {
  if (folder_.Use(digest) || !LinkedObject(digest).empty()) return true;
  if (!shelf_) return false;
  return shelf_->Confirm(digest);
}

bool KeptBlobs::Verify(const Digest& digest) {
  return folder_.Verify(digest) || (shelf_ && shelf_->Use(digest)) || !LinkedObject(digest).empty();
}

absl::Status KeptBlobs::Refresh() {
  constexpr int64_t kMostAge_s = 300;
  return shelf_ ? shelf_->Refresh(kMostAge_s) : absl::OkStatus();
}

absl::StatusOr<std::vector<StoredBlob>> KeptBlobs::List() {
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<StoredBlob> listed, folder_.List());
  if (!shelf_) return listed;
  ORBWEAVE_RETURN_IF_ERROR(shelf_->Refresh());
  std::map<Digest, uint64_t> sizes;
  for (const StoredBlob& blob : listed) sizes[blob.digest] += blob.size_bytes;
  for (const StoredBlob& blob : shelf_->List()) sizes[blob.digest] += blob.size_bytes;
  listed.clear();
  for (const auto& [digest, size_bytes] : sizes) listed.push_back({digest, size_bytes});
  return listed;
}

bool KeptBlobs::IsUnused(const Digest& digest, double unused_s) {
  return folder_.IsUnused(digest, unused_s) && (!shelf_ || shelf_->IsUnused(digest, unused_s));
}

absl::StatusOr<bool> KeptBlobs::RemoveUnused(const Digest& digest, double unused_s) {
  if (!IsUnused(digest, unused_s) || !folder_.RemoveUnused(digest, unused_s)) return false;
  if (!shelf_) return true;
  return shelf_->RemoveUnused(digest, unused_s);
}

absl::Status KeptBlobs::Probe(std::string_view bytes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, folder_.Put(bytes));
  ORBWEAVE_RETURN_IF_ERROR(folder_.Get(digest).status());
  (void)folder_.RemoveUnused(digest, 0.0);  // or else there is one blob more until it is garbage
  return shelf_ ? Annotate(shelf_->Probe(bytes), "object store") : absl::OkStatus();
}

}  // namespace orbweave
