// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "worker/seam_stages.h"

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "core/merging/align_submodels.h"
#include "core/merging/review_seams.h"
#include "core/stages/plan_recipes.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/seams_codec.h"
#include "proto/codec/two_view_codec.h"
#include "worker/stage_io.h"

namespace orbweave {

absl::StatusOr<TaskResult> RunListSeams(const TaskSpec& spec,
                                        BlobAccess& blobs,
                                        const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            FetchInput(spec, 0, blobs, DecodeDividedViewGraph));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> rims,
                            FetchInput(spec, 1, blobs, DecodeCollection));
  if (rims.size() != divided.partition.clusters.size())
    return absl::InvalidArgumentError("list_seams: one rim per cluster");
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(
      PutRecipes(PlanSeams(divided.partition, rims), EncodeCollection, blobs, result));
  result.report_json = nlohmann::json{{"seams", divided.partition.seams.size()}}.dump();
  return result;
}

absl::StatusOr<TaskResult> RunFitSeams(const TaskSpec& spec,
                                       BlobAccess& blobs,
                                       const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> rims,
                            FetchInput(spec, 0, blobs, DecodeCollection));
  if (rims.empty()) return absl::InvalidArgumentError("fit_seams: no cluster");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Submodel> own,
                            LoadRims(std::span(rims).first(1), blobs));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Submodel> later,
                            LoadRims(std::span(rims).subspan(1), blobs));
  ORBWEAVE_ASSIGN_OR_RETURN(const SeamsOfCluster seams,
                            FitSeams(own, later, options.align.max_error_px, context));
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeSeamsOfCluster(seams), blobs, result));
  result.report_json =
      nlohmann::json{{"submodels", own.size()}, {"seams", seams.seams.size()}}.dump();
  return result;
}

absl::StatusOr<TaskResult> RunAlignSubmodels(const TaskSpec& spec,
                                             BlobAccess& blobs,
                                             const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests,
                            FetchInput(spec, 0, blobs, DecodeCollection));
  std::vector<SeamsOfCluster> clusters;
  for (const Digest& digest : digests) {
    ORBWEAVE_ASSIGN_OR_RETURN(clusters.emplace_back(),
                              FetchBlob(digest, blobs, DecodeSeamsOfCluster));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment,
                            AlignSubmodels(clusters, options.align, context));
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeAlignment(alignment), blobs, result));
  result.report_json =
      nlohmann::json{{"submodels", alignment.submodels.size()}, {"seams", alignment.seams.size()}}
          .dump();
  return result;
}

absl::StatusOr<TaskResult> RunReviewSeams(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext&) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            FetchInput(spec, 0, blobs, DecodeDividedViewGraph));
  ORBWEAVE_ASSIGN_OR_RETURN(const Alignment alignment, FetchInput(spec, 1, blobs, DecodeAlignment));
  ORBWEAVE_ASSIGN_OR_RETURN(const PartitionReview before,
                            FetchInput(spec, 2, blobs, DecodePartitionReview));
  const PartitionReview review =
      ReviewSeams(divided.partition, alignment, before, options.partition);
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodePartitionReview(review), blobs, result));
  if (review.rounds > before.rounds) result.recipes = result.outputs;
  result.report_json =
      nlohmann::json{{"rounds", review.rounds}, {"requests", review.requests.size()}}.dump();
  return result;
}

}  // namespace orbweave
