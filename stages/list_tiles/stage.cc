// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_tiles/stage.h"

#include <map>
#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/dense_codecs.h"

namespace orbweave {

absl::Status ListTilesStage::Run(StageTask<ListTilesStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> runs, task.Read(&ListTilesStage::runs));
  std::map<TileCell, TileRecipe> tiles;
  for (const Digest& digest : runs) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(const TileRuns of_panorama, task.Fetch<TileRuns>(digest));
    for (const PointsOfCell& run : of_panorama.runs) {
      TileRecipe& tile = tiles[run.cell];
      tile.cell = run.cell;
      tile.points.push_back(run.points);
    }
  }
  for (const auto& [cell, recipe] : tiles)
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::tiles, recipe));
  task.Report(nlohmann::json{{"tiles", tiles.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
