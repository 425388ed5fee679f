// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/assemble_tile/stage.h"

#include <iterator>
#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/dense_codecs.h"

namespace orbweave {

absl::Status AssembleTileStage::Run(StageTask<AssembleTileStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const TileRecipe recipe, task.Read(&AssembleTileStage::recipe));
  DenseTile tile{.cell = recipe.cell, .piece = recipe.piece};
  for (const Digest& digest : recipe.points) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(const SurfacePoints points, task.Fetch<SurfacePoints>(digest));
    tile.points.insert(tile.points.end(), points.begin(), points.end());
  }
  const std::vector<TileRun> runs = GroupByTile({}, tile.points);
  if (runs.size() != 1 || runs.front().cell != tile.cell)
    return absl::InvalidArgumentError("assemble_tile: points of another tile, or none");
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::tile, tile).status());
  task.Report(nlohmann::json{{"points", tile.points.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
