// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "core/base/status.h"

namespace orbweave {

/// Writes `bytes` to `path` so that a crash at any moment leaves the old file, none, or the whole
/// new one: temporary file in `scratch_dir` (same file system), fsync, rename, fsync of the folder.
/// ResourceExhausted: disk full. PermissionDenied, Unavailable: the system's reason, with the path.
[[nodiscard]] absl::Status WriteFileDurably(const std::string& scratch_dir,
                                            const std::string& path,
                                            std::string_view bytes);

/// The whole file. NotFound when there is none.
[[nodiscard]] absl::StatusOr<std::string> ReadWholeFile(const std::string& path);

/// Creates a folder and those above it, unless it is there.
[[nodiscard]] absl::Status MakeFolder(const std::string& path);

/// Creates `path`, or removes every file in it.
[[nodiscard]] absl::Status MakeEmptyFolder(const std::string& path);

}  // namespace orbweave
