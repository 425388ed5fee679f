// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/format_dense.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_format.h"
#include "core/io/printable_text.h"

namespace orbweave {
namespace {

std::vector<double> ToList(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::string FormatDense(const DenseReport& report, const std::string& folder) {
  std::string text = absl::StrFormat(
      "%d points on %d tiles from %d panoramas (%.0f %% of their sphere checked), %.0f s\n",
      report.num_points,
      report.tiles.size(),
      report.panoramas,
      100.0 * report.coverage,
      report.elapsed_s);
  for (size_t i = 0; i < report.omitted.size() && i < 5; ++i)
    text += absl::StrFormat(
        "without depth: %s: %s\n", report.omitted[i].name, report.omitted[i].reason);
  if (report.omitted.size() > 5)
    text += absl::StrFormat("and %d more, in %s/report.json\n", report.omitted.size() - 5, folder);
  return text + absl::StrFormat("%s/cloud.las, tiles/*.ply, report.json\n", folder);
}

std::string DenseReportJson(const DenseReport& report) {
  nlohmann::json omitted = nlohmann::json::array();
  for (const Exclusion& image : report.omitted)
    omitted.push_back({{"image", image.name}, {"reason", image.reason}});
  nlohmann::json tiles = nlohmann::json::array();
  for (const TileReport& tile : report.tiles) {
    tiles.push_back({{"x", tile.cell.x},
                     {"y", tile.cell.y},
                     {"file", tile.file},
                     {"points", tile.num_points},
                     {"low", ToList(tile.low)},
                     {"high", ToList(tile.high)}});
  }
  return nlohmann::json{{"points", report.num_points},
                        {"panoramas", report.panoramas},
                        {"coverage", report.coverage},
                        {"sigma_mm_below", {1, 2, 4, 8, 16, 32, 64}},
                        {"points_by_sigma", report.by_sigma},
                        {"points_by_views", report.by_views},
                        {"elapsed_s", report.elapsed_s},
                        {"cpu_s", report.cpu_s},
                        {"tiles", tiles},
                        {"without_depth", omitted}}
             .dump(1) +
         "\n";
}

}  // namespace orbweave
