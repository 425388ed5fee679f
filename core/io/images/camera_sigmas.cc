// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/images/camera_sigmas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/base/status.h"
#include "core/io/text_fields.h"

namespace orbweave {
namespace {

constexpr std::array<const char*, 4> kColumns = {"name", "sigma_x", "sigma_y", "sigma_z"};

absl::StatusOr<std::array<size_t, 4>> FindColumns(std::string_view header,
                                                  std::string_view source) {
  const std::vector<std::string> cells = SplitFields(header, ',');
  std::array<size_t, 4> columns{};
  for (size_t c = 0; c < kColumns.size(); ++c) {
    const auto found = std::ranges::find(cells, kColumns[c]);
    if (found == cells.end()) {
      return absl::InvalidArgumentError(std::string(source) + ": the header has no column '" +
                                        kColumns[c] + "'");
    }
    columns[c] = static_cast<size_t>(found - cells.begin());
  }
  return columns;
}

}  // namespace

absl::StatusOr<std::map<std::string, Eigen::Vector3d>> ParseCameraSigmas(std::string_view text,
                                                                         std::string_view source) {
  std::map<std::string, Eigen::Vector3d> sigmas;
  const std::vector<std::string_view> lines = SplitLines(text);
  if (lines.empty()) return sigmas;
  ORBWEAVE_ASSIGN_OR_RETURN(const auto columns, FindColumns(lines.front(), source));
  for (size_t line = 1; line < lines.size(); ++line) {
    if (lines[line].empty()) continue;
    const std::vector<std::string> cells = SplitFields(lines[line], ',');
    const auto error = [&](const std::string& what) {
      return absl::InvalidArgumentError(std::string(source) + " line " + std::to_string(line + 1) +
                                        ": " + what);
    };
    if (cells.size() <= *std::ranges::max_element(columns)) return error("too few cells");
    if (cells[columns[1]].empty()) continue;
    Eigen::Vector3d& sigma = sigmas[cells[columns[0]]];
    for (int axis = 0; axis < 3; ++axis) {
      const std::string& cell = cells[columns[static_cast<size_t>(axis) + 1]];
      const std::optional<double> number = NumberFromText(cell);
      if (!number || !std::isfinite(*number) || *number < 0.0)
        return error("'" + cell + "' is no sigma");
      sigma[axis] = *number;
    }
  }
  return sigmas;
}

}  // namespace orbweave
