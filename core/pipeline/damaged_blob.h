// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <optional>

#include "core/base/digest.h"
#include "core/base/status.h"

namespace orbweave {

/// `error` when it is DataLoss, with the name of the blob that it comes of: its bytes are those
/// that are named, and they are not what they should be. Another error, or one that names a blob
/// already, stays as it is.
[[nodiscard]] absl::Status BlameBlob(absl::Status error, const Digest& blob);

/// The blob that an error comes of; nothing: none that is known.
[[nodiscard]] std::optional<Digest> BlobToBlame(const absl::Status& error);

}  // namespace orbweave
