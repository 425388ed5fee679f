// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/dense_report_json.h"

#include "core/io/json_text.h"
#include "core/io/page/report_json_rows.h"

namespace orbweave {
namespace {

Json ToJson(const TileReport& tile) {
  return {{"x", tile.cell.x},
          {"y", tile.cell.y},
          {"file", tile.file},
          {"points", tile.num_points},
          {"low", VectorJson(tile.low)},
          {"high", VectorJson(tile.high)}};
}

Json ToJson(const DepthMapReport& map) {
  return {{"image", map.image}, {"coverage", map.coverage}};
}

Json ToJson(const Exclusion& image) { return {{"image", image.name}, {"reason", image.reason}}; }

template <typename T>
Json ToJson(const std::vector<T>& rows) {
  Json list = Json::array();
  for (const T& row : rows) list.push_back(ToJson(row));
  return list;
}

}  // namespace

std::string DenseReportJson(const DenseReport& report) {
  return JsonText({{"version", report.version},
                   {"title", report.title},
                   {"unit", report.is_metric ? "m" : "free"},
                   {"points", report.num_points},
                   {"panoramas", report.maps.size()},
                   {"coverage", report.Coverage()},
                   {"sigma_unit", report.sigma_unit},
                   {"sigma_below_thousandths", DenseReport::kSigmaBounds},
                   {"points_by_sigma", report.by_sigma},
                   {"points_by_views", report.by_views},
                   {"elapsed_s", report.elapsed_s},
                   {"cpu_s", report.Cpu_s()},
                   {"tiles", ToJson(report.tiles)},
                   {"maps", ToJson(report.maps)},
                   {"without_depth", ToJson(report.omitted)},
                   {"stages", StagesJson(report.stages)}});
}

}  // namespace orbweave
