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
/// we may not. A file of root's that a group of ours may read and nobody else is taken too: so
/// engines hand secrets to who is not root. NotFound: there is none.
[[nodiscard]] absl::StatusOr<std::string> ReadSecretFile(const std::string& path);

/// The same of a file that others may read, such as the certificate of an authority.
/// PermissionDenied: others may write it.
[[nodiscard]] absl::StatusOr<std::string> ReadTrustedFile(const std::string& path);

}  // namespace orbweave
