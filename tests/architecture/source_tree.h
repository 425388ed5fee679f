// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace orbweave::architecture {

struct SourceFile {
  std::string path{};  ///< relative to the root of the repository, '/' as separator
  std::string text{};
};

/// The text files of the repository below the given folders (or the given files themselves), sorted
/// by path. Folders named build*, or beginning with a dot, are left out, and so are files that hold
/// a zero byte.
[[nodiscard]] std::vector<SourceFile> ReadTree(const std::vector<std::string>& roots);

/// The text of one file of the repository; empty when it is missing.
[[nodiscard]] std::string ReadRepositoryFile(std::string_view path);

/// True for .h and .cc files.
[[nodiscard]] bool IsCpp(std::string_view path);

}  // namespace orbweave::architecture
