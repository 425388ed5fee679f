// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "absl/status/statusor.h"

namespace orbweave {

/// The content of a text file as UTF-8; bytes that are none become U+FFFD. InvalidArgument: the
/// file is UTF-16, as spreadsheets save "Unicode text" (it begins with that mark, or has zero
/// bytes), with what to do. Codes of ReadFile.
[[nodiscard]] absl::StatusOr<std::string> ReadTextFile(const std::string& path);

/// The same of the bytes of a file that is called `path` in errors.
[[nodiscard]] absl::StatusOr<std::string> TextOfFile(const std::string& bytes,
                                                     const std::string& path);

}  // namespace orbweave
