// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/plan_depths/stage.h"

#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/plan_depths/plan_depths.h"

namespace orbweave {

absl::Status PlanDepthsStage::Run(StageTask<PlanDepthsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest, task.Read(&PlanDepthsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const FinalisedModel model, task.Read(&PlanDepthsStage::model));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> chosen, task.Read(&PlanDepthsStage::chosen));
  DepthPlanner planner(manifest, model, task.options<SourceOptions>().max_width_px);
  for (const Digest& digest : chosen) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(const ChosenSources views, task.Fetch<ChosenSources>(digest));
    ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<DepthRecipe> recipes, planner.Plan(views));
    ORBWEAVE_RETURN_IF_ERROR(task.LeaveAll(&Outputs::depths, recipes));
  }
  const DensePlan plan = std::move(planner).Finish();
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::plan, plan).status());
  task.Report(
      nlohmann::json{{"panoramas", plan.panoramas.size()}, {"without_depth", plan.omitted.size()}}
          .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
