// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/architecture/source_tree.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace orbweave::architecture {
namespace {

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

bool IsLeftOut(const fs::path& folder) {
  const std::string name = folder.filename();
  return name.starts_with(".") || name.starts_with("build");
}

void AddFile(const fs::path& root, const fs::path& path, std::vector<SourceFile>& files) {
  std::string text = ReadFile(path);
  if (text.find('\0') != std::string::npos) return;
  files.push_back({fs::relative(path, root).generic_string(), std::move(text)});
}

}  // namespace

std::vector<SourceFile> ReadTree(const std::vector<std::string>& roots) {
  const fs::path repository = ORBWEAVE_SOURCE_DIR;
  std::vector<SourceFile> files;
  for (const std::string& name : roots) {
    const fs::path root = repository / name;
    if (fs::is_regular_file(root)) AddFile(repository, root, files);
    if (!fs::is_directory(root)) continue;
    for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
      if (entry->is_directory() && IsLeftOut(entry->path())) entry.disable_recursion_pending();
      if (entry->is_regular_file()) AddFile(repository, entry->path(), files);
    }
  }
  std::sort(files.begin(), files.end(), [](const SourceFile& x, const SourceFile& y) {
    return x.path < y.path;
  });
  return files;
}

std::string ReadRepositoryFile(std::string_view path) {
  return ReadFile(fs::path(ORBWEAVE_SOURCE_DIR) / path);
}

bool IsCpp(std::string_view path) { return path.ends_with(".h") || path.ends_with(".cc"); }

}  // namespace orbweave::architecture
