// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

// What a coordinator does with blobs.

#include "absl/strings/str_cat.h"
#include "coordinator/collect_garbage.h"
#include "coordinator/coordinator.h"

namespace orbweave {

absl::StatusOr<std::string> Coordinator::Get(const Digest& digest) {
  absl::StatusOr<std::string> bytes = blobs_.Get(digest);
  if (bytes.ok()) bytes_out_ += bytes->size();
  return bytes;
}

absl::StatusOr<Digest> Coordinator::Put(std::string_view bytes) {
  absl::StatusOr<Digest> digest = blobs_.Put(bytes);
  if (digest.ok()) bytes_in_ += bytes.size();
  return digest;
}

absl::Status Coordinator::Read(const Digest& digest, const TakePiece& take) {
  return blobs_.Read(digest, [&](std::string_view piece) {
    bytes_out_ += piece.size();
    return take(piece);
  });
}

absl::Status Coordinator::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  return blobs_.Write(digest, size_bytes, [&]() -> absl::StatusOr<std::string_view> {
    absl::StatusOr<std::string_view> piece = next();
    if (piece.ok()) bytes_in_ += piece->size();
    return piece;
  });
}

absl::StatusOr<std::vector<bool>> Coordinator::StatBlobs(const std::vector<Digest>& digests) {
  return blobs_.StatBlobs(digests);
}

absl::Status Coordinator::LinkFile(const Digest& digest, const std::string& path) {
  return blobs_.LinkFile(digest, path);
}

absl::StatusOr<std::vector<BlobGrant>> Coordinator::GrantBlobs(const std::vector<WantedBlob>& blobs,
                                                               GrantVerb verb) {
  return blobs_.Grant(blobs, verb, kGrant_s);
}

absl::Status Coordinator::FinishUpload(const UploadEnd& end) { return blobs_.FinishUpload(end); }

absl::StatusOr<GarbageReport> Coordinator::CollectGarbage(const GarbageOptions& options) {
  const std::lock_guard collecting(collecting_mutex_);
  ORBWEAVE_ASSIGN_OR_RETURN(
      const GarbageReport report,
      orbweave::CollectGarbage(options, options_.find_plan, blobs_, *journal_));
  const absl::Status called_off =
      options.dry_run ? absl::OkStatus() : blobs_.AbortUploads(options.unused_s);
  const std::lock_guard lock(mutex_);
  if (!called_off.ok()) {  // a right that is missing; the rest is done
    dispatcher_.Log({.level = LogLevel::kWarning,
                     .event = "uploads_not_called_off",
                     .message = std::string(called_off.message())});
  }
  dispatcher_.Log({.event = options.dry_run ? "garbage_counted" : "garbage_collected",
                   .message = absl::StrCat("blobs=",
                                           report.removed_blobs,
                                           " bytes=",
                                           report.removed_bytes,
                                           " results=",
                                           report.forgotten_results)});
  return report;
}

}  // namespace orbweave
