// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_seams/stage.h"

#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/list_seams/plan_seams.h"

namespace orbweave {

absl::Status ListSeamsStage::Run(StageTask<ListSeamsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided, task.Read(&ListSeamsStage::divided));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> boundaries,
                            task.Read(&ListSeamsStage::boundaries));
  if (boundaries.size() != divided.partition.clusters.size())
    return absl::InvalidArgumentError("list_seams: one rim per cluster");
  ORBWEAVE_RETURN_IF_ERROR(
      task.LeaveAll(&Outputs::rims_to_compare, PlanSeams(divided.partition, boundaries)));
  task.Report(nlohmann::json{{"seams", divided.partition.seams.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
