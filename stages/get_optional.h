// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/base/status.h"
#include "core/pipeline/blob_access.h"

namespace orbweave {

/// A blob that may have no name, as the mask of an image without one; then no bytes.
inline absl::StatusOr<std::string> GetOptional(const Digest& digest, BlobAccess& blobs) {
  if (digest.IsZero()) return std::string();
  return blobs.Get(digest);
}

}  // namespace orbweave
