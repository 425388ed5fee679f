// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "core/base/digest.h"

namespace orbweave {

/// Content-addressed bytes. Thread-safe.
class BlobAccess {
 public:
  virtual ~BlobAccess() = default;
  /// The bytes named `digest`, verified. NotFound: nobody has them. DataLoss: what is stored is not
  /// what was named. Unavailable: try again. May be repeated.
  [[nodiscard]] virtual absl::StatusOr<std::string> Get(const Digest& digest) = 0;
  /// Stores bytes under their digest; harmless when repeated. ResourceExhausted: disk full.
  [[nodiscard]] virtual absl::StatusOr<Digest> Put(std::string_view bytes) = 0;
};

}  // namespace orbweave
