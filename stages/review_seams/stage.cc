// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/review_seams/stage.h"

#include <nlohmann/json.hpp>

#include "core/artifacts/check_bounds.h"
#include "stages/codecs.h"

namespace orbweave {

absl::Status ReviewSeamsStage::Run(StageTask<ReviewSeamsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided, task.Read(&ReviewSeamsStage::divided));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment, task.Read(&ReviewSeamsStage::alignment));
  ORBWEAVE_ASSIGN_OR_RETURN(const PartitionReview before, task.Read(&ReviewSeamsStage::before));
  ORBWEAVE_RETURN_IF_ERROR(CheckAlignedClusters(alignment, divided.partition));
  ORBWEAVE_RETURN_IF_ERROR(CheckRequests(before.requests, divided.partition));
  const PartitionReview review =
      ReviewSeams(divided.partition, alignment, before, task.options<PartitionOptions>());
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::review, review).status());
  if (review.rounds > before.rounds)
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::another_round, review));
  task.Report(
      nlohmann::json{{"rounds", review.rounds}, {"requests", review.requests.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
