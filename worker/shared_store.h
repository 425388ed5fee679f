// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "core/pipeline/blob_access.h"
#include "core/storage/blob_store.h"

namespace orbweave {

/// The coordinator's blobs for a worker that sees the folder where they lie: they are read and
/// written there, past the coordinator. What is not there is the coordinator's to give, as are
/// files it only links to. Without such a folder it is the coordinator alone. Thread-safe, after
/// the first Check.
class SharedStore final : public BlobAccess {
 public:
  /// `folder`: the coordinator's blob folder as this machine sees it; empty: it does not.
  SharedStore(BlobAccess& coordinator, std::string folder)
      : coordinator_(coordinator), folder_(std::move(folder)) {}

  /// Whether the coordinator finds what is written to the folder; to be asked once per session,
  /// before anything else. FailedPrecondition: it does not, so that this is another's folder.
  /// Unavailable: the coordinator is away, or there is no room now.
  [[nodiscard]] absl::Status Check();

  [[nodiscard]] absl::StatusOr<std::string> Get(const Digest& digest) override;
  [[nodiscard]] absl::StatusOr<Digest> Put(std::string_view bytes) override;
  [[nodiscard]] absl::Status Read(const Digest& digest, const TakePiece& take) override;
  [[nodiscard]] absl::Status Write(const Digest& digest,
                                   uint64_t size_bytes,
                                   const NextPiece& next) override;

 private:
  BlobAccess& coordinator_;
  std::string folder_;
  std::optional<BlobStore> shared_;
};

}  // namespace orbweave
