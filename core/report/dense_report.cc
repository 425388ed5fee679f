// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/report/dense_report.h"

#include <numeric>

namespace orbweave {

double DenseReport::Coverage() const {
  const double sum =
      std::accumulate(maps.begin(), maps.end(), 0.0, [](double part, const DepthMapReport& map) {
        return part + map.coverage;
      });
  return maps.empty() ? 0.0 : sum / static_cast<double>(maps.size());
}

double DenseReport::Cpu_s() const {
  return std::accumulate(
      stages.begin(), stages.end(), 0.0, [](double part, const ReportStage& stage) {
        return part + stage.cpu_s;
      });
}

}  // namespace orbweave
