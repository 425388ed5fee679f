// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/metered_blobs.h"

namespace orbweave {

absl::StatusOr<std::string> MeteredBlobs::Get(const Digest& digest) {
  absl::StatusOr<std::string> bytes = blobs_.Get(digest);
  if (bytes.ok()) bytes_in_ += bytes->size();
  return bytes;
}

absl::StatusOr<Digest> MeteredBlobs::Put(std::string_view bytes) {
  absl::StatusOr<Digest> digest = blobs_.Put(bytes);
  if (digest.ok()) bytes_out_ += bytes.size();
  return digest;
}

}  // namespace orbweave
