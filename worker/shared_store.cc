// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/shared_store.h"

#include <random>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {
namespace {

/// Bytes that no store has.
std::string NeverSeen() {
  std::random_device device;
  return absl::StrCat("orbweave shared store ", device(), " ", device(), " ", device());
}

}  // namespace

absl::Status SharedStore::Check() {
  if (folder_.empty()) return absl::OkStatus();
  if (!shared_) {
    ORBWEAVE_ASSIGN_OR_RETURN(shared_, BlobStore::Share(folder_));
  }
  const absl::StatusOr<Digest> written = shared_->Put(NeverSeen());
  if (absl::IsResourceExhausted(written.status()))
    return absl::UnavailableError(written.status().message());
  ORBWEAVE_RETURN_IF_ERROR(written.status());
  const absl::Status found = coordinator_.Get(*written).status();
  (void)shared_->RemoveUnused(*written, 0.0);
  if (!absl::IsNotFound(found)) return found;
  return absl::FailedPreconditionError(absl::StrCat(
      folder_,
      " is the blob folder of another coordinator: name that of this one (blobs in its "
      "state folder) as this machine sees it, or none"));
}

absl::StatusOr<std::string> SharedStore::Get(const Digest& digest) {
  absl::StatusOr<std::string> bytes = absl::NotFoundError("no shared folder");
  if (shared_) bytes = shared_->Get(digest);
  return absl::IsNotFound(bytes.status()) ? coordinator_.Get(digest) : bytes;
}

absl::StatusOr<Digest> SharedStore::Put(std::string_view bytes) {
  return shared_ ? shared_->Put(bytes) : coordinator_.Put(bytes);
}

absl::Status SharedStore::Read(const Digest& digest, const TakePiece& take) {
  // What is not there is noticed before the first piece.
  const absl::Status read = shared_ ? shared_->Read(digest, take) : absl::NotFoundError("");
  return absl::IsNotFound(read) ? coordinator_.Read(digest, take) : read;
}

absl::Status SharedStore::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  return shared_ ? shared_->Write(digest, size_bytes, next)
                 : coordinator_.Write(digest, size_bytes, next);
}

}  // namespace orbweave
