// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/assemble_block/stage.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/artifacts/check_bounds.h"
#include "core/merging/boundary_tracks.h"
#include "stages/codecs.h"

namespace orbweave {

absl::Status AssembleBlockStage::Run(StageTask<AssembleBlockStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(AssembleRecipe recipe, task.Read(&AssembleBlockStage::recipe));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterResult cluster,
                            task.Fetch<ClusterResult>(recipe.cluster_result));
  const std::vector<Reconstruction>& submodels = cluster.reconstruction.submodels;
  if (cluster.cluster != recipe.joined.subproblem.cluster)
    return BlameBlob(DoesNotFit("a block is made from another cluster"), recipe.cluster_result);
  std::vector<Reconstruction> inner;
  for (const PlacedSubmodel& placed : recipe.joined.submodels) {
    ORBWEAVE_RETURN_IF_ERROR(
        CheckNumber(placed.submodel, submodels.size(), "a block is made from submodel"));
    inner.push_back(InteriorTracksOf(submodels[placed.submodel], recipe.shared));
  }
  const Subproblem subproblem = AssembleSubproblem(std::move(recipe.joined), std::move(inner));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::subproblem, subproblem).status());
  task.Report(nlohmann::json{{"images", subproblem.images.size()},
                             {"tracks", subproblem.scene.tracks.size()}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
