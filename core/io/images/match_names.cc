// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/match_names.h"

#include <array>
#include <map>

#include "core/io/text_fields.h"

namespace orbweave {
namespace {

std::string SameName(const std::string& name) { return name; }

std::string AnyCase(const std::string& name) { return LowerText(name); }

std::string BaseName(const std::string& name) {
  return LowerText(name.substr(name.rfind('/') + 1));
}

std::string Stem(const std::string& name) {
  const std::string base = BaseName(name);
  return base.substr(0, base.rfind('.'));
}

/// Indices of the unmatched entries by their key.
std::map<std::string, std::vector<size_t>> IndexByKey(const std::vector<std::string>& names,
                                                      const std::vector<bool>& matched,
                                                      std::string (*key)(const std::string&)) {
  std::map<std::string, std::vector<size_t>> index;
  for (size_t i = 0; i < names.size(); ++i) {
    if (!matched[i]) index[key(names[i])].push_back(i);
  }
  return index;
}

}  // namespace

std::vector<std::optional<size_t>> MatchNames(const std::vector<std::string>& image_names,
                                              const std::vector<std::string>& row_names) {
  std::vector<std::optional<size_t>> row_of_image(image_names.size());
  std::vector<bool> image_matched(image_names.size(), false);
  std::vector<bool> row_matched(row_names.size(), false);
  for (const auto key : std::array{SameName, AnyCase, BaseName, Stem}) {
    const auto images = IndexByKey(image_names, image_matched, key);
    const auto rows = IndexByKey(row_names, row_matched, key);
    for (const auto& [name, image] : images) {
      const auto row = rows.find(name);
      if (row == rows.end() || image.size() != 1 || row->second.size() != 1) continue;
      row_of_image[image.front()] = row->second.front();
      image_matched[image.front()] = true;
      row_matched[row->second.front()] = true;
    }
  }
  return row_of_image;
}

}  // namespace orbweave
