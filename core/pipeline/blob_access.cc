// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/pipeline/blob_access.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"

namespace orbweave {

NextPiece PiecesOf(std::string_view bytes) {
  return [rest = bytes]() mutable -> absl::StatusOr<std::string_view> {
    const std::string_view piece = rest.substr(0, kPieceBytes);
    rest.remove_prefix(piece.size());
    return piece;
  };
}

absl::Status BlobAccess::Read(const Digest& digest, const TakePiece& take) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, Get(digest));
  return take(bytes);
}

absl::Status BlobAccess::Write(const Digest& digest, uint64_t size_bytes, const NextPiece& next) {
  std::string bytes;
  while (true) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string_view piece, next());
    if (piece.empty()) break;
    bytes += piece;
  }
  if (bytes.size() == size_bytes && DigestOf(bytes) == digest) return Put(bytes).status();
  return absl::DataLossError(absl::StrCat("not the bytes of blob ", digest.ToShortHex()));
}

}  // namespace orbweave
