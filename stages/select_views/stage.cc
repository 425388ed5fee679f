// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/select_views/stage.h"

#include <nlohmann/json.hpp>

#include "core/partitioned_ba/subproblem.h"
#include "stages/codecs.h"
#include "stages/dense_codecs.h"

namespace orbweave {
namespace {

std::vector<ImageId> OwnedImages(const Subproblem& subproblem) {
  std::vector<ImageId> owned;
  for (const SubproblemImage& image : subproblem.images) {
    if (subproblem.Owns(image)) owned.push_back(image.id);
  }
  return owned;
}

/// The subproblem's scene, its parts of split tracks with it.
Reconstruction SceneOf(Subproblem subproblem, const Sim3& model_from_world) {
  Reconstruction scene = std::move(subproblem.scene);
  for (SplitTrack& track : subproblem.split) scene.tracks.push_back(std::move(track.part));
  return Transformed(model_from_world, std::move(scene));
}

}  // namespace

absl::Status SelectViewsStage::Run(StageTask<SelectViewsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ViewRecipe recipe, task.Read(&SelectViewsStage::view));
  ORBWEAVE_ASSIGN_OR_RETURN(Subproblem subproblem, task.Fetch<Subproblem>(recipe.subproblem));
  const std::vector<ImageId> owned = OwnedImages(subproblem);
  const Reconstruction scene = SceneOf(std::move(subproblem), recipe.model_from_world);
  const ChosenSources chosen{
      .world = recipe.world,
      .choices = SelectSources(scene.images, owned, scene.tracks, task.options<SourceOptions>())};
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::chosen, chosen).status());
  task.Report(nlohmann::json{{"panoramas", chosen.choices.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
