// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/io/page/report_json_rows.h"

namespace orbweave {

Json VectorJson(const Eigen::Vector3d& vector) {
  return Json::array({vector.x(), vector.y(), vector.z()});
}

Json StagesJson(std::span<const ReportStage> stages) {
  Json list = Json::array();
  for (const ReportStage& stage : stages) {
    list.push_back({{"name", stage.name},
                    {"wall_s", stage.wall_s},
                    {"cpu_s", stage.cpu_s},
                    {"tasks_computed", stage.tasks_computed},
                    {"tasks_reused", stage.tasks_reused},
                    {"retries", stage.retries}});
  }
  return list;
}

}  // namespace orbweave
