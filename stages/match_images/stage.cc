// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/match_images/stage.h"

#include "stages/codecs.h"
#include "stages/match_images/match_run.h"

namespace orbweave {

absl::Status MatchImagesStage::Run(StageTask<MatchImagesStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const MatchRecipe recipe, task.Read(&MatchImagesStage::run));
  ORBWEAVE_ASSIGN_OR_RETURN(const MatchedRun run,
                            MatchRun(recipe,
                                     task.blobs(),
                                     task.options<MatchOptions>(),
                                     task.options<TwoViewOptions>(),
                                     task.context()));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::verified, run.verified).status());
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::matched, run.matched).status());
  task.Report(run.report_json);
  return absl::OkStatus();
}

}  // namespace orbweave
