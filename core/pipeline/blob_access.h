// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/digest.h"

namespace orbweave {

/// The most bytes of a blob that are handed on at a time.
inline constexpr size_t kPieceBytes = size_t{512} << 10;

/// Takes the next bytes of a blob; its error ends the reading.
using TakePiece = std::function<absl::Status(std::string_view piece)>;
/// Gives the next bytes of a blob, valid until it is called again; none: that was all.
using NextPiece = std::function<absl::StatusOr<std::string_view>()>;

/// The pieces of `bytes`, which outlive what is returned.
[[nodiscard]] NextPiece PiecesOf(std::string_view bytes);

/// Content-addressed bytes. Thread-safe.
class BlobAccess {
 public:
  virtual ~BlobAccess() = default;
  /// The bytes named `digest`, verified. NotFound: nobody has them. DataLoss: what is stored is not
  /// what was named. Unavailable: try again. May be repeated.
  [[nodiscard]] virtual absl::StatusOr<std::string> Get(const Digest& digest) = 0;
  /// Stores bytes under their digest; harmless when repeated. ResourceExhausted: disk full.
  [[nodiscard]] virtual absl::StatusOr<Digest> Put(std::string_view bytes) = 0;

  /// Get in pieces, for who does not want to hold all bytes at once. They are verified with the
  /// last of them: what `take` was given counts only when this returns OK.
  [[nodiscard]] virtual absl::Status Read(const Digest& digest, const TakePiece& take);
  /// Put in pieces, of which there are `size_bytes` bytes altogether. Asks for none, or not for
  /// all, when the blob is stored already. DataLoss: they are not what was named, and are not
  /// stored.
  [[nodiscard]] virtual absl::Status Write(const Digest& digest,
                                           uint64_t size_bytes,
                                           const NextPiece& next);
};

}  // namespace orbweave
