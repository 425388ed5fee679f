// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "coordinator/object_shelf.h"

#include <unordered_set>
#include <utility>

#include "absl/strings/str_cat.h"

namespace orbweave {
namespace {

/// The object that says whose the store is.
constexpr char kOwnerKey[] = "coordinator";
/// The object of a Probe.
constexpr char kProbeKey[] = "probe";

absl::Status BeingRemoved(const Digest& digest) {
  return absl::UnavailableError(
      absl::StrCat("blob ", digest.ToShortHex(), " is just being removed"));
}

}  // namespace

absl::StatusOr<std::unique_ptr<ObjectShelf>> ObjectShelf::Open(std::shared_ptr<ObjectStore> store,
                                                               const std::string& owner,
                                                               UnixClock clock) {
  std::unique_ptr<ObjectShelf> shelf(new ObjectShelf(std::move(store), std::move(clock)));
  ORBWEAVE_RETURN_IF_ERROR(shelf->Claim(owner));
  ORBWEAVE_RETURN_IF_ERROR(shelf->Refresh());
  return shelf;
}

absl::StatusOr<std::string> ObjectShelf::ReadOwner() {
  std::string owner;
  ORBWEAVE_RETURN_IF_ERROR(store_->Get(kOwnerKey, std::nullopt, [&owner](std::string_view piece) {
    owner += piece;
    return absl::OkStatus();
  }));
  return owner;
}

absl::Status ObjectShelf::Claim(const std::string& owner) {
  absl::StatusOr<std::string> present = ReadOwner();
  if (absl::IsNotFound(present.status())) {
    ORBWEAVE_RETURN_IF_ERROR(store_->Put(kOwnerKey, DigestOf(owner), owner));
    present = ReadOwner();  // another one's, where two came at a time
  }
  ORBWEAVE_RETURN_IF_ERROR(present.status());
  if (*present == owner) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat(
      "the object store is that of another coordinator, whose state is not this one: "
      "give this one a prefix of its own, or, if the other is no more, remove the object '",
      kOwnerKey,
      "'"));
}

bool ObjectShelf::Has(const Digest& digest) {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(digest);
  return entry != entries_.end() && !entry->second.is_leaving;
}

bool ObjectShelf::Use(const Digest& digest) {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(digest);
  if (entry == entries_.end() || entry->second.is_leaving) return false;
  entry->second.used_unix_s = clock_();
  return true;
}

absl::StatusOr<bool> ObjectShelf::Confirm(const Digest& digest) {
  {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(digest);
    if (entry != entries_.end() && entry->second.is_leaving) return BeingRemoved(digest);
  }
  if (Use(digest)) return true;
  const absl::StatusOr<ObjectInfo> info = store_->Head(digest.ToHex());
  if (absl::IsNotFound(info.status())) return false;
  ORBWEAVE_RETURN_IF_ERROR(info.status());
  const std::lock_guard lock(mutex_);
  entries_[digest] = {.size_bytes = info->size_bytes, .used_unix_s = clock_(), .noted = lists_};
  return true;
}

void ObjectShelf::Forget(const Digest& digest) {
  const std::lock_guard lock(mutex_);
  entries_.erase(digest);
}

absl::Status ObjectShelf::Read(const Digest& digest, const TakePiece& take) {
  DigestBuilder builder;
  const absl::Status read = store_->Get(digest.ToHex(), std::nullopt, [&](std::string_view piece) {
    builder.Add(piece);
    return take(piece);
  });
  if (absl::IsNotFound(read)) {
    const std::lock_guard lock(mutex_);
    entries_.erase(digest);
    listed_unix_s_ = 0;  // others may be gone as well
    return absl::NotFoundError(absl::StrCat("blob ", digest.ToShortHex(), " is not stored"));
  }
  ORBWEAVE_RETURN_IF_ERROR(read);
  if (builder.Finish() == digest) return absl::OkStatus();
  ORBWEAVE_RETURN_IF_ERROR(store_->Delete(digest.ToHex()));
  Forget(digest);
  return absl::DataLossError(
      absl::StrCat("blob ", digest.ToShortHex(), " is damaged: its object has other bytes"));
}

std::optional<ObjectGrant> ObjectShelf::GrantGet(const Digest& digest, int valid_s) {
  if (!Use(digest)) return std::nullopt;
  return store_->GrantGet(digest.ToHex(), valid_s);
}

absl::StatusOr<ObjectGrant> ObjectShelf::GrantPut(const Digest& digest,
                                                  uint64_t size_bytes,
                                                  int valid_s) {
  {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(digest);
    if (entry != entries_.end() && entry->second.is_leaving) return BeingRemoved(digest);
  }
  return store_->GrantPut(digest.ToHex(), digest, size_bytes, valid_s);
}

absl::StatusOr<std::string> ObjectShelf::BeginUpload(const Digest& digest) {
  {
    const std::lock_guard lock(mutex_);
    const auto entry = entries_.find(digest);
    if (entry != entries_.end() && entry->second.is_leaving) return BeingRemoved(digest);
  }
  return store_->BeginUpload(digest.ToHex());
}

ObjectGrant ObjectShelf::GrantPart(const Digest& digest, const ObjectPart& part, int valid_s) {
  return store_->GrantPart(digest.ToHex(), part, valid_s);
}

absl::Status ObjectShelf::FinishUpload(const UploadEnd& end) {
  if (end.etags.empty()) return store_->AbortUpload(end.digest.ToHex(), end.upload);
  return store_->FinishUpload(end.digest.ToHex(), end.upload, end.etags);
}

absl::Status ObjectShelf::AbortUploads(double unused_s) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<UploadInfo> uploads, store_->ListUploads());
  for (const UploadInfo& upload : uploads) {
    if (static_cast<double>(clock_() - upload.begun_unix_s) < unused_s) continue;
    ORBWEAVE_RETURN_IF_ERROR(store_->AbortUpload(upload.key, upload.upload));
  }
  return absl::OkStatus();
}

absl::Status ObjectShelf::Refresh(int64_t most_age_s) {
  const int64_t now_unix_s = clock_();
  uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    if (now_unix_s - listed_unix_s_ < most_age_s) return absl::OkStatus();
    number = ++lists_;
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<ObjectInfo> objects, store_->List());
  const std::lock_guard lock(mutex_);
  std::unordered_set<Digest> listed;
  for (const ObjectInfo& object : objects) {
    const absl::StatusOr<Digest> digest = Digest::FromHex(object.key);
    if (!digest.ok()) continue;
    listed.insert(*digest);
    entries_.try_emplace(*digest,
                         Entry{.size_bytes = object.size_bytes,
                               .used_unix_s = object.modified_unix_s,
                               .noted = number});
  }
  std::erase_if(entries_, [&](const auto& entry) {
    return entry.second.noted < number && !listed.contains(entry.first);
  });
  listed_unix_s_ = now_unix_s;
  return absl::OkStatus();
}

std::vector<StoredBlob> ObjectShelf::List() {
  const std::lock_guard lock(mutex_);
  std::vector<StoredBlob> blobs;
  for (const auto& [digest, entry] : entries_) blobs.push_back({digest, entry.size_bytes});
  return blobs;
}

bool ObjectShelf::IsUnused(const Digest& digest, double unused_s) {
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(digest);
  return entry == entries_.end() ||
         static_cast<double>(clock_() - entry->second.used_unix_s) >= unused_s;
}

bool ObjectShelf::BeginToRemove(const Digest& digest, double unused_s) {
  if (!IsUnused(digest, unused_s)) return false;
  const std::lock_guard lock(mutex_);
  const auto entry = entries_.find(digest);
  if (entry != entries_.end()) entry->second.is_leaving = true;
  return true;
}

absl::StatusOr<bool> ObjectShelf::RemoveUnused(const Digest& digest, double unused_s) {
  if (!BeginToRemove(digest, unused_s)) return false;
  const absl::Status removed = store_->Delete(digest.ToHex());
  // Whether it is still there after an error, the next list tells.
  Forget(digest);
  ORBWEAVE_RETURN_IF_ERROR(removed);
  return true;
}

absl::Status ObjectShelf::Probe(std::string_view bytes) {
  // One that a crash left may have other bytes, and would never be written over.
  ORBWEAVE_RETURN_IF_ERROR(store_->Delete(kProbeKey));
  ORBWEAVE_RETURN_IF_ERROR(store_->Put(kProbeKey, DigestOf(bytes), bytes));
  std::string read;
  ORBWEAVE_RETURN_IF_ERROR(store_->Get(kProbeKey, std::nullopt, [&read](std::string_view piece) {
    read += piece;
    return absl::OkStatus();
  }));
  if (read == bytes) return absl::OkStatus();
  return absl::DataLossError("the object store gives other bytes than were put");
}

}  // namespace orbweave
