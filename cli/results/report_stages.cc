// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/report_stages.h"

namespace orbweave {

std::vector<ReportStage> ReportStages(const JobStatus& status) {
  std::vector<ReportStage> stages;
  for (const StageStatus& stage : status.stages) {
    stages.push_back({.name = stage.stage,
                      .wall_s = stage.wall_s,
                      .cpu_s = stage.cpu_s,
                      .tasks_computed = stage.tasks_done - stage.tasks_reused,
                      .tasks_reused = stage.tasks_reused,
                      .retries = stage.retries});
  }
  return stages;
}

}  // namespace orbweave
