// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_tiles/stage.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/list_tiles/plan_tiles.h"

namespace orbweave {

absl::Status ListTilesStage::Run(StageTask<ListTilesStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> runs, task.Read(&ListTilesStage::runs));
  TilePlanner planner(static_cast<uint64_t>(task.options<TileOptions>().max_points));
  for (const Digest& digest : runs) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(const TileRuns of_panorama, task.Fetch<TileRuns>(digest));
    planner.Add(of_panorama);
  }
  const std::vector<TileRecipe> recipes = planner.Recipes();
  ORBWEAVE_RETURN_IF_ERROR(task.LeaveAll(&Outputs::tiles, recipes));
  task.Report(nlohmann::json{{"tiles", recipes.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
