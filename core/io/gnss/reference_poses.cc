// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/gnss/reference_poses.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/status.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr std::array<const char*, 8> kColumns = {"name", "x", "y", "z", "qw", "qx", "qy", "qz"};

absl::Status Error(std::string_view source, size_t line, const std::string& what) {
  return absl::InvalidArgumentError(absl::StrCat(std::string(source), " line ", line, ": ", what));
}

absl::StatusOr<std::array<size_t, 8>> FindColumns(const std::vector<std::string>& header,
                                                  std::string_view source) {
  std::array<size_t, 8> columns{};
  for (size_t c = 0; c < kColumns.size(); ++c) {
    const auto found = std::find(header.begin(), header.end(), kColumns[c]);
    if (found == header.end()) {
      return Error(
          source,
          1,
          absl::StrCat("the header has no column '", kColumns[c], "' (name,x,y,z,qw,qx,qy,qz)"));
    }
    columns[c] = static_cast<size_t>(found - header.begin());
  }
  return columns;
}

}  // namespace

absl::StatusOr<std::map<std::string, Rigid3>> ParseReferencePoses(std::string_view text,
                                                                  std::string_view source) {
  std::map<std::string, Rigid3> poses;
  std::array<size_t, 8> columns{};
  size_t line_number = 0;
  for (absl::string_view line : absl::StrSplit(absl::string_view(text.data(), text.size()), '\n')) {
    ++line_number;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty()) continue;
    const std::vector<std::string> cells =
        SplitFields(std::string_view(line.data(), line.size()), ',');
    if (line_number == 1) {
      ORBWEAVE_ASSIGN_OR_RETURN(columns, FindColumns(cells, source));
      continue;
    }
    if (cells.size() <= *std::max_element(columns.begin(), columns.end())) {
      return Error(source, line_number, "too few cells");
    }
    std::array<double, 7> v{};
    for (size_t k = 0; k < v.size(); ++k) {
      const std::string& cell = cells[columns[k + 1]];
      const auto end = std::from_chars(cell.data(), cell.data() + cell.size(), v[k]);
      if (end.ec != std::errc() || end.ptr != cell.data() + cell.size() || !std::isfinite(v[k])) {
        return Error(source, line_number, absl::StrCat("'", cell, "' is not a number"));
      }
    }
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    if (!(q.norm() > 0.5 && q.norm() < 2.0))
      return Error(source, line_number, "the quaternion is not of unit length");
    poses[cells[columns[0]]] =
        Rigid3::FromCentre(q.normalized(), Eigen::Vector3d(v[0], v[1], v[2]));
  }
  return poses;
}

}  // namespace orbweave
