// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>

#include "core/base/status.h"
#include "core/pipeline/blob_access.h"
#include "core/pipeline/blob_grant.h"
#include "objects/http_client.h"
#include "orbweave/v1/coordinator.grpc.pb.h"

namespace orbweave {

/// The blobs that lie in the object store of a coordinator, for who has no keys to it: read and
/// written there by the rights that the coordinator grants. Thread-safe.
class GrantedBlobs {
 public:
  /// See BlobAccess::Read; nothing: the coordinator gives it itself. Unavailable also: it was
  /// damaged on its way. Internal: this machine cannot use the store, and why.
  [[nodiscard]] std::optional<absl::Status> Read(v1::Coordinator::Stub& stub,
                                                 const Digest& digest,
                                                 const TakePiece& take);
  /// See BlobAccess::Write; nothing: the coordinator takes it itself. Errors as of Read.
  [[nodiscard]] std::optional<absl::Status> Write(v1::Coordinator::Stub& stub,
                                                  const Digest& digest,
                                                  uint64_t size_bytes,
                                                  const NextPiece& next);

 private:
  [[nodiscard]] absl::StatusOr<HttpClient*> Http();
  /// A blob for which there is a grant of kParts.
  [[nodiscard]] absl::Status WriteParts(v1::Coordinator::Stub& stub,
                                        const Digest& digest,
                                        uint64_t size_bytes,
                                        const BlobGrant& grant,
                                        const NextPiece& next);

  std::atomic<bool> has_store_{true};  ///< until the coordinator says otherwise
  std::mutex mutex_;
  std::unique_ptr<HttpClient> http_;
};

}  // namespace orbweave
