// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/reconstruct_cluster/stage.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/mapping/reconstruct_cluster.h"
#include "core/merging/boundary_tracks.h"
#include "stages/codecs.h"
#include "stages/reconstruct_cluster/assemble_cluster.h"

namespace orbweave {
namespace {

absl::StatusOr<ClusterProblem> FetchProblem(const ClusterRecipe& recipe,
                                            StageTask<ReconstructClusterStage>& task) {
  ClusterProblem problem;
  for (size_t i = 0; i < recipe.images.size(); ++i) {
    const FeatureFile& file = recipe.images[i];
    ORBWEAVE_ASSIGN_OR_RETURN(const Features features, task.Fetch<Features>(file.features));
    problem.images.push_back(ToClusterImage(file.image, features));
    problem.images.back().drive = recipe.drives[i];
    problem.images.back().rank_in_drive = recipe.ranks[i];
  }
  for (const Digest& digest : recipe.matches) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto geometries, task.Fetch<std::vector<TwoViewGeometry>>(digest));
    TakePairs(recipe, std::move(geometries), problem);
  }
  TakeFixes(recipe, problem);
  return problem;
}

ClusterResult BoundaryOfCluster(const ClusterResult& cluster, const std::vector<ImageId>& shared) {
  ClusterResult boundary{.cluster = cluster.cluster};
  for (const Reconstruction& submodel : cluster.reconstruction.submodels)
    boundary.reconstruction.submodels.push_back(BoundaryTracksOf(submodel, shared));
  return boundary;
}

}  // namespace

absl::Status ReconstructClusterStage::Run(StageTask<ReconstructClusterStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterRecipe recipe,
                            task.Read(&ReconstructClusterStage::cluster));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterProblem problem, FetchProblem(recipe, task));
  ClusterResult cluster{.cluster = recipe.cluster};
  ORBWEAVE_ASSIGN_OR_RETURN(
      cluster.reconstruction,
      ReconstructCluster(problem, task.options<MappingOptions>(), task.context()));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::whole, cluster).status());
  ORBWEAVE_RETURN_IF_ERROR(
      task.Leave(&Outputs::boundary, BoundaryOfCluster(cluster, recipe.shared)).status());
  const std::vector<Reconstruction>& submodels = cluster.reconstruction.submodels;
  size_t registered = 0;
  for (const Reconstruction& submodel : submodels) registered += submodel.images.size();
  task.Report(nlohmann::json{{"images", problem.images.size()},
                             {"registered", registered},
                             {"components", submodels.size()},
                             {"joined_components", cluster.reconstruction.num_joined},
                             {"residual_rms_px", cluster.reconstruction.residual_rms_px},
                             {"started_globally", cluster.reconstruction.started_globally},
                             {"start_remark", cluster.reconstruction.start_remark}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
