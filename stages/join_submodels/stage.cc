// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/join_submodels/stage.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/artifacts/check_bounds.h"
#include "core/graph/shared_images.h"
#include "core/merging/join_submodels.h"
#include "stages/codecs.h"
#include "stages/load_rims.h"

namespace orbweave {

absl::Status JoinSubmodelsStage::Run(StageTask<JoinSubmodelsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest, task.Read(&JoinSubmodelsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            task.Read(&JoinSubmodelsStage::divided));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> clusters,
                            task.Read(&JoinSubmodelsStage::clusters));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> boundary_blobs,
                            task.Read(&JoinSubmodelsStage::boundaries));
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Submodel> boundaries,
                            LoadBoundaries(boundary_blobs, task.blobs()));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment, task.Read(&JoinSubmodelsStage::alignment));
  ORBWEAVE_RETURN_IF_ERROR(CheckPartition(divided.partition, manifest));
  ORBWEAVE_RETURN_IF_ERROR(CheckSubmodels(boundaries, alignment, divided.partition));
  if (clusters.size() != divided.partition.clusters.size())
    return DoesNotFit("not one reconstruction for each cluster");
  // Options of later steps do not change what is drawn, so that subproblems keep their names.
  StageContext seeded = task.context();
  seeded.seed = task.DigestOf(&JoinSubmodelsStage::boundaries).ToSeed();
  ORBWEAVE_ASSIGN_OR_RETURN(JoinedSubmodels joined,
                            JoinSubmodels(std::move(boundaries),
                                          alignment,
                                          divided.partition,
                                          manifest,
                                          task.options<AlignOptions>(),
                                          task.options<GlobalAdjustOptions>(),
                                          seeded));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::worlds, joined.worlds).status());
  for (JoinedSubproblem& subproblem : joined.subproblems) {
    const uint32_t cluster = subproblem.subproblem.cluster;
    const AssembleRecipe recipe{
        std::move(subproblem), clusters[cluster], SharedImages(divided.partition, cluster)};
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::subproblems, recipe));
  }
  task.Report(
      nlohmann::json{{"worlds", joined.worlds.size()}, {"blocks", joined.subproblems.size()}}
          .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
