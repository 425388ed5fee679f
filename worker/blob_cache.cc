// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/blob_cache.h"

#include "worker/retry.h"

namespace orbweave {
namespace {

absl::StatusOr<SharedBytes> Fetch(BlobAccess& source, const Digest& digest) {
  SharedBytesBuilder bytes;
  ORBWEAVE_RETURN_IF_ERROR(
      source.Read(digest, [&bytes](std::string_view piece) { return bytes.Append(piece); }));
  return bytes.Finish();
}

}  // namespace

absl::StatusOr<SharedBytes> BlobCache::Get(const Digest& digest) {
  {
    const std::lock_guard lock(mutex_);
    const auto it = places_.find(digest);
    if (it != places_.end()) {
      entries_.splice(entries_.begin(), entries_, it->second);
      return it->second->second;
    }
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const SharedBytes bytes,
                            Retry({.stop = stop_}, [&] { return Fetch(source_, digest); }));
  Keep(digest, bytes);
  return bytes;
}

absl::Status BlobCache::Put(const Digest& digest, const SharedBytes& bytes) {
  const std::string_view view = bytes.View();
  ORBWEAVE_RETURN_IF_ERROR(
      Retry({.stop = stop_}, [&] { return source_.Write(digest, view.size(), PiecesOf(view)); }));
  Keep(digest, bytes);
  return absl::OkStatus();
}

void BlobCache::Keep(const Digest& digest, const SharedBytes& bytes) {
  const std::lock_guard lock(mutex_);
  const size_t size = bytes.View().size();
  if (size > capacity_bytes_ || places_.contains(digest)) return;
  entries_.emplace_front(digest, bytes);
  places_[digest] = entries_.begin();
  size_bytes_ += size;
  while (size_bytes_ > capacity_bytes_) {
    size_bytes_ -= entries_.back().second.View().size();
    places_.erase(entries_.back().first);
    entries_.pop_back();
  }
}

}  // namespace orbweave
