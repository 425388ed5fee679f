// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_views/stage.h"

#include "stages/codecs.h"
#include "stages/dense_codecs.h"

namespace orbweave {

absl::Status ListViewsStage::Run(StageTask<ListViewsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const FinalisedModel model, task.Read(&ListViewsStage::model));
  for (uint32_t world = 0; world < model.worlds.size(); ++world) {
    for (const Digest& subproblem : model.subproblems[world]) {
      ORBWEAVE_RETURN_IF_ERROR(
          task.Leave(&Outputs::views,
                     ViewRecipe{.world = world,
                                .model_from_world = model.worlds[world].model_from_world,
                                .subproblem = subproblem}));
    }
  }
  return absl::OkStatus();
}

}  // namespace orbweave
