// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_checks/stage.h"

#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/place_maps.h"

namespace orbweave {

absl::Status ListChecksStage::Run(StageTask<ListChecksStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DensePlan plan, task.Read(&ListChecksStage::plan));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> maps, task.Read(&ListChecksStage::maps));
  ORBWEAVE_ASSIGN_OR_RETURN(const PlacedMaps placed, PlaceMaps(plan, maps, MapUnit::kOwn));
  for (const DensePanorama& panorama : plan.panoramas) {
    CheckRecipe recipe{.own = placed.at(panorama.file.image)};
    for (const ImageId source : panorama.sources) {
      const auto found = placed.find(source);
      if (found != placed.end()) recipe.sources.push_back(found->second);
    }
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::checks, recipe));
  }
  return absl::OkStatus();
}

}  // namespace orbweave
