// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace orbweave::architecture {

/// A third-party header prefix and the path prefixes of files that may include it. A path prefix
/// ends at a folder's border, or, with a trailing '_', within a file name.
struct Fence {
  std::string header_prefix{};
  std::vector<std::string> allowed{};
};

/// The file LAYERS: who may see whom.
struct Layers {
  std::map<std::string, int> row_of_folder{};
  std::vector<Fence> fences{};

  /// The longest folder of the table that holds `path`, empty when there is none.
  [[nodiscard]] std::string FolderOf(std::string_view path) const;
};

/// Rows of folders, bottom first; lines "fence PREFIX FOLDER..."; '#' begins a comment.
[[nodiscard]] Layers ParseLayers(std::string_view text);

/// One #include line.
struct Include {
  int line = 0;
  std::string target{};
};

[[nodiscard]] std::vector<Include> FindIncludes(std::string_view source);

/// What is wrong with the includes of a source file, as "path:line: complaint" lines.
[[nodiscard]] std::vector<std::string> CheckIncludes(const Layers& layers,
                                                     const std::string& path,
                                                     std::string_view source);

}  // namespace orbweave::architecture
