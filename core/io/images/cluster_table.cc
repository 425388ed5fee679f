// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/io/images/cluster_table.h"

#include <algorithm>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/status.h"
#include "core/io/first_names.h"
#include "core/io/images/match_names.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr size_t kNamesShown = 5;

struct ClusterRows {
  std::vector<std::string> names{};
  std::vector<std::string> clusters{};
};

/// Position of the column called `title`; the number of columns where there is none.
size_t ColumnOf(const std::vector<std::string>& header, std::string_view title) {
  const auto found = std::ranges::find_if(
      header, [&](const std::string& field) { return LowerText(field) == title; });
  return static_cast<size_t>(found - header.begin());
}

absl::StatusOr<ClusterRows> ReadRows(std::string_view text, const std::string& source) {
  const std::vector<std::string_view> lines = SplitLines(text);
  const auto header = lines.empty() ? std::vector<std::string>{} : SplitFields(lines[0], ',');
  const size_t name = ColumnOf(header, "name");
  const size_t cluster = ColumnOf(header, "cluster");
  if (name == header.size() || cluster == header.size()) {
    return absl::InvalidArgumentError(
        absl::StrCat(source, ": the first line has to name the columns name and cluster"));
  }
  ClusterRows rows;
  std::set<std::string> seen;
  for (size_t i = 1; i < lines.size(); ++i) {
    if (TrimmedText(lines[i]).empty()) continue;
    const std::vector<std::string> fields = SplitFields(lines[i], ',');
    if (fields.size() <= std::max(name, cluster) || fields[name].empty() ||
        fields[cluster].empty()) {
      return absl::InvalidArgumentError(
          absl::StrCat(source, " line ", i + 1, ": a name and a cluster are needed"));
    }
    if (!seen.insert(fields[name]).second) {
      return absl::InvalidArgumentError(
          absl::StrCat(source, " line ", i + 1, ": ", fields[name], " is named again"));
    }
    rows.names.push_back(fields[name]);
    rows.clusters.push_back(fields[cluster]);
  }
  return rows;
}

}  // namespace

absl::StatusOr<ClusterNames> ReadClusterTable(std::string_view text,
                                              const std::string& source,
                                              const std::vector<std::string>& image_names) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterRows rows, ReadRows(text, source));
  const std::vector<std::optional<size_t>> row_of_image = MatchNames(image_names, rows.names);
  ClusterNames clusters;
  std::vector<std::string> missing;
  std::vector<bool> is_used(rows.names.size(), false);
  for (size_t i = 0; i < image_names.size(); ++i) {
    if (!row_of_image[i]) {
      missing.push_back(image_names[i]);
      continue;
    }
    clusters[image_names[i]] = rows.clusters[*row_of_image[i]];
    is_used[*row_of_image[i]] = true;
  }
  std::vector<std::string> unknown;
  for (size_t r = 0; r < is_used.size(); ++r) {
    if (!is_used[r]) unknown.push_back(rows.names[r]);
  }
  if (!unknown.empty()) {
    return absl::InvalidArgumentError(absl::StrCat(unknown.size(),
                                                   unknown.size() == 1 ? " row of " : " rows of ",
                                                   source,
                                                   unknown.size() == 1 ? " names" : " name",
                                                   " no image: ",
                                                   FirstNames(unknown, kNamesShown)));
  }
  if (!missing.empty()) {
    return absl::InvalidArgumentError(
        absl::StrCat(missing.size(),
                     missing.size() == 1 ? " image has" : " images have",
                     " no row in ",
                     source,
                     ": ",
                     FirstNames(missing, kNamesShown)));
  }
  return clusters;
}

}  // namespace orbweave
