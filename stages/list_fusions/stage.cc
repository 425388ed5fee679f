// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_fusions/stage.h"

#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/list_fusions/mutual_neighbours.h"
#include "stages/place_maps.h"

namespace orbweave {
namespace {

constexpr size_t kMaxNeighbours = 26;  // depth maps in the memory of a task

}  // namespace

absl::Status ListFusionsStage::Run(StageTask<ListFusionsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DensePlan plan, task.Read(&ListFusionsStage::plan));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> maps, task.Read(&ListFusionsStage::maps));
  ORBWEAVE_ASSIGN_OR_RETURN(PlacedMaps placed, PlaceMaps(plan, maps, MapUnit::kModel));
  const std::vector<Neighbourhood> neighbourhoods = MutualNeighbours(plan, kMaxNeighbours);
  for (size_t i = 0; i < plan.panoramas.size(); ++i)
    placed.at(plan.panoramas[i].file.image).reach_m = neighbourhoods[i].reach_m;
  for (size_t i = 0; i < plan.panoramas.size(); ++i) {
    if (!neighbourhoods[i].gives_points) continue;
    const PanoramaFile& file = plan.panoramas[i].file;
    FuseRecipe recipe{
        .own = placed.at(file.image), .file = file, .mask_ignores_white = plan.mask_ignores_white};
    for (const ImageId image : neighbourhoods[i].neighbours)
      recipe.neighbours.push_back(placed.at(image));
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::fusions, recipe));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
