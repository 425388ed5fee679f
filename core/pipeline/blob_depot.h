// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/pipeline/blob_access.h"

namespace orbweave {

/// The coordinator's blobs for who brings a job's inputs. Codes common to all: Unavailable
/// (connection; try again).
class BlobDepot : public BlobAccess {
 public:
  /// Which of these blobs are stored (same order).
  [[nodiscard]] virtual absl::StatusOr<std::vector<bool>> StatBlobs(
      const std::vector<Digest>& digests) = 0;
  /// Registers a file on the coordinator's machine, or an object beneath one of its roots
  /// (s3://BUCKET/KEY), as a blob without copying it; verified at every read. NotFound /
  /// PermissionDenied: the coordinator cannot read it; FailedPrecondition: what it was told of the
  /// store is wrong; DataLoss: a file with another digest.
  [[nodiscard]] virtual absl::Status LinkFile(const Digest& digest, const std::string& path) = 0;
};

}  // namespace orbweave
