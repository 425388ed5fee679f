// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// Creates or replaces `path`, readable and writable by its owner alone (mode 0600) from its first
/// moment on; a crash leaves the old file or the new one. Unavailable, PermissionDenied,
/// ResourceExhausted: the system's reason with the path; no message repeats the bytes.
[[nodiscard]] absl::Status WriteSecretFile(const std::string& path, std::string_view bytes);

/// The content of a file of at most 1 MiB. PermissionDenied: anybody but its owner may read it, or
/// we may not. NotFound: there is none.
[[nodiscard]] absl::StatusOr<std::string> ReadSecretFile(const std::string& path);

}  // namespace orbweave
