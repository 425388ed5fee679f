// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/architecture/layers.h"

#include <regex>
#include <sstream>

namespace orbweave::architecture {
namespace {

bool HoldsPath(std::string_view prefix, std::string_view path) {
  if (!path.starts_with(prefix)) return false;
  return path.size() == prefix.size() || prefix.ends_with('_') || prefix.ends_with('/') ||
         path[prefix.size()] == '/';
}

bool MayPass(const Fence& fence, std::string_view path) {
  for (const std::string& allowed : fence.allowed) {
    if (HoldsPath(allowed, path)) return true;
  }
  return false;
}

// Why `from` may not see `to`; empty when it may.
std::string Complain(const Layers& layers, const std::string& from, const std::string& to) {
  if (from == to || to.empty()) return "";
  const int from_row = layers.row_of_folder.at(from);
  const int to_row = layers.row_of_folder.at(to);
  if (to_row > from_row) return from + " looks up to " + to;
  if (to_row == from_row) return from + " looks sideways to " + to;
  return "";
}

}  // namespace

std::string Layers::FolderOf(std::string_view path) const {
  std::string longest;
  for (const auto& [folder, row] : row_of_folder) {
    if (HoldsPath(folder, path) && folder.size() > longest.size()) longest = folder;
  }
  return longest;
}

Layers ParseLayers(std::string_view text) {
  Layers layers;
  std::istringstream lines{std::string(text)};
  int row = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word;
    if (!(words >> word)) continue;
    if (word == "fence") {
      Fence& fence = layers.fences.emplace_back();
      words >> fence.header_prefix;
      while (words >> word) fence.allowed.push_back(word);
      continue;
    }
    do {
      layers.row_of_folder[word] = row;
    } while (words >> word);
    ++row;
  }
  return layers;
}

std::vector<Include> FindIncludes(std::string_view source) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> includes;
  std::istringstream lines{std::string(source)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    std::smatch match;
    if (std::regex_search(line, match, kInclude)) includes.push_back({number, match[1]});
  }
  return includes;
}

std::vector<std::string> CheckIncludes(const Layers& layers,
                                       const std::string& path,
                                       std::string_view source) {
  std::vector<std::string> complaints;
  const std::string folder = layers.FolderOf(path);
  if (folder.empty()) return {path + ":1: its folder is in no row of LAYERS"};
  for (const Include& include : FindIncludes(source)) {
    const std::string place = path + ":" + std::to_string(include.line) + ": ";
    const std::string complaint = Complain(layers, folder, layers.FolderOf(include.target));
    if (!complaint.empty()) complaints.push_back(place + complaint);
    for (const Fence& fence : layers.fences) {
      if (include.target.starts_with(fence.header_prefix) && !MayPass(fence, path)) {
        complaints.push_back(place + include.target + " is fenced off");
      }
    }
  }
  return complaints;
}

}  // namespace orbweave::architecture
