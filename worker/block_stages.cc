// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/block_stages.h"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "core/merging/rim.h"
#include "core/stages/plan_recipes.h"
#include "proto/codec/block_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/two_view_codec.h"
#include "worker/stage_io.h"

namespace orbweave {

absl::StatusOr<TaskResult> RunJoinSubmodels(const TaskSpec& spec,
                                            BlobAccess& blobs,
                                            const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            FetchInput(spec, 0, blobs, DecodeImageManifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            FetchInput(spec, 1, blobs, DecodeDividedViewGraph));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> clusters,
                            FetchInput(spec, 2, blobs, DecodeCollection));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> rim_blobs,
                            FetchInput(spec, 3, blobs, DecodeCollection));
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<Submodel> rims, LoadRims(rim_blobs, blobs));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment, FetchInput(spec, 4, blobs, DecodeAlignment));
  if (alignment.world.size() != rims.size())
    return absl::InvalidArgumentError("join_submodels: the alignment is of other submodels");
  // Options of later steps do not change what is drawn, so that blocks keep their names.
  StageContext seeded = context;
  seeded.seed = spec.inputs[3].ToSeed();
  ORBWEAVE_ASSIGN_OR_RETURN(JoinedSubmodels joined,
                            JoinSubmodels(std::move(rims),
                                          alignment,
                                          divided.partition,
                                          manifest,
                                          options.align,
                                          options.global,
                                          seeded));

  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeJoinedWorlds(joined.worlds), blobs, result));
  for (JoinedBlock& block : joined.blocks) {
    const uint32_t cluster = block.block.cluster;
    const AssembleRecipe recipe{
        std::move(block), clusters.at(cluster), SharedImages(divided.partition, cluster)};
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, blobs.Put(EncodeAssembleRecipe(recipe)));
    result.recipes.push_back(digest);
  }
  result.report_json =
      nlohmann::json{{"worlds", joined.worlds.size()}, {"blocks", joined.blocks.size()}}.dump();
  return result;
}

absl::StatusOr<TaskResult> RunAssembleBlock(const TaskSpec& spec,
                                            BlobAccess& blobs,
                                            const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(AssembleRecipe recipe,
                            FetchInput(spec, 0, blobs, DecodeAssembleRecipe));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterResult cluster,
                            FetchBlob(recipe.cluster_result, blobs, DecodeClusterResult));
  std::vector<Reconstruction> inner;
  for (const PlacedComponent& placed : recipe.joined.components) {
    inner.push_back(InnerOf(cluster.reconstruction.components.at(placed.component), recipe.shared));
  }
  const WorldBlock block = AssembleBlock(std::move(recipe.joined), std::move(inner));
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeWorldBlock(block), blobs, result));
  result.report_json =
      nlohmann::json{{"images", block.images.size()}, {"tracks", block.scene.tracks.size()}}.dump();
  return result;
}

}  // namespace orbweave
