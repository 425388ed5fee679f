// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/plans.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "stages/adjust_block/stage.h"
#include "stages/align_submodels/stage.h"
#include "stages/assemble_block/stage.h"
#include "stages/assemble_tile/stage.h"
#include "stages/check_depths/stage.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/dense_codecs.h"
#include "stages/estimate_depths/stage.h"
#include "stages/extract_features/stage.h"
#include "stages/fit_seams/stage.h"
#include "stages/fuse_panorama/stage.h"
#include "stages/ingest_images/stage.h"
#include "stages/join_submodels/stage.h"
#include "stages/list_checks/stage.h"
#include "stages/list_extractions/stage.h"
#include "stages/list_fusions/stage.h"
#include "stages/list_pairs/stage.h"
#include "stages/list_seams/stage.h"
#include "stages/list_tiles/stage.h"
#include "stages/list_views/stage.h"
#include "stages/match_images/stage.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plan_builder.h"
#include "stages/plan_depths/stage.h"
#include "stages/reconstruct_cluster/stage.h"
#include "stages/review_seams/stage.h"
#include "stages/select_image_pairs/stage.h"
#include "stages/select_views/stage.h"
#include "stages/select_wider_pairs/stage.h"
#include "stages/steer_adjustment/stage.h"
#include "stages/verify_matches/stage.h"

namespace orbweave {
namespace {

/// Rounds that the global adjustment in subproblems usually takes.
constexpr double kUsualRounds = 26.0;
/// What the largest options may ask for: 11 phases of 1,000 steps, each of two rounds and one more.
constexpr uint32_t kMostRounds = 11 * (2 * 1000 + 1) + 1;
/// The same of reviews, each a round, and the first.
constexpr uint32_t kMostReviews = 11;
/// The first pairs, these by features of facade views too, those after them, the reserve, those
/// matched again.
constexpr uint32_t kMostMatchings = 5;

/// What a model is made from.
struct VerifiedImages {
  One<ImageManifest> manifest;
  Interleaved<Features, PlaceSample> features;
  EachPart<std::vector<TwoViewGeometry>> verified;
  One<ClusterNames> clusters_by_hand;
};

VerifiedImages AddImageStages(const SparseJob& job, PlanBuilder& plan) {
  const auto ingested = plan.Add(IngestImagesStage{.sources = job.sources});
  const auto wider = RoundBefore(OutputsOf<SelectWiderPairsStage>().wider);
  const auto listed_images =
      plan.Add(ListExtractionsStage{.manifest = ingested.manifest, .wider = wider});
  const auto extracted = plan.Add(ExtractFeaturesStage{.image = listed_images.images});
  const auto features = Interleave(extracted.features, extracted.places);
  const auto pairs =
      plan.Add(SelectImagePairsStage{.manifest = ingested.manifest, .features = features});
  const auto listed = plan.Add(ListPairsStage{.candidates = pairs.candidates,
                                              .carriers = pairs.carriers,
                                              .features = features,
                                              .wider = wider});
  const auto matched = plan.Add(MatchImagesStage{.run = listed.runs});
  plan.Add(SelectWiderPairsStage{.manifest = ingested.manifest,
                                 .candidates = pairs.candidates,
                                 .matched = matched.matched,
                                 .before = wider});
  plan.RepeatFrom<ListExtractionsStage>(1.0, kMostMatchings);
  return {ingested.manifest, features, matched.verified, job.clusters_by_hand};
}

VerifiedImages AddVerification(const SparseFromMatchesJob& job, PlanBuilder& plan) {
  const auto matched = plan.Add(VerifyMatchesStage{.run = job.runs});
  return {job.manifest, job.features, matched.verified, job.clusters_by_hand};
}

void AddModelStages(const VerifiedImages& images, PlanBuilder& plan) {
  const auto partition = plan.Add(
      PartitionViewGraphStage{.manifest = images.manifest,
                              .features = images.features,
                              .verified = images.verified,
                              .clusters_by_hand = images.clusters_by_hand,
                              .before = RoundBefore(OutputsOf<PartitionViewGraphStage>().divided),
                              .review = RoundBefore(OutputsOf<ReviewSeamsStage>().review)});
  const auto clusters = plan.Add(ReconstructClusterStage{.cluster = partition.clusters});
  const auto listed =
      plan.Add(ListSeamsStage{.divided = partition.divided, .boundaries = clusters.boundary});
  const auto fitted = plan.Add(FitSeamsStage{.boundaries = listed.rims_to_compare});
  const auto aligned = plan.Add(AlignSubmodelsStage{.seams = fitted.seams});
  plan.Add(ReviewSeamsStage{.divided = partition.divided,
                            .alignment = aligned.alignment,
                            .before = RoundBefore(OutputsOf<ReviewSeamsStage>().review)});
  plan.RepeatFrom<PartitionViewGraphStage>(1.0, kMostReviews);

  const auto joined = plan.Add(JoinSubmodelsStage{.manifest = images.manifest,
                                                  .divided = partition.divided,
                                                  .clusters = clusters.whole,
                                                  .boundaries = clusters.boundary,
                                                  .alignment = aligned.alignment});
  const auto assembled = plan.Add(AssembleBlockStage{.recipe = joined.subproblems});
  const auto steered = plan.Add(
      SteerAdjustmentStage{.worlds = joined.worlds,
                           .subproblems = assembled.subproblem,
                           .before = RoundBefore(OutputsOf<SteerAdjustmentStage>().progress),
                           .replies = RoundBefore(OutputsOf<AdjustBlockStage>().reply)});
  plan.Add(AdjustBlockStage{.request = steered.requests});
  plan.RepeatFrom<SteerAdjustmentStage>(kUsualRounds, kMostRounds);

  plan.Add(ConcludeAdjustmentStage{.manifest = images.manifest,
                                   .worlds = joined.worlds,
                                   .progress = steered.progress,
                                   .divided = partition.divided});
}

/// From a finished model to one cloud of points, each piece of surface once.
void AddDenseStages(const One<ImageManifest>& manifest,
                    const One<FinalisedModel>& model,
                    PlanBuilder& plan) {
  const auto listed = plan.Add(ListViewsStage{.model = model});
  const auto chosen = plan.Add(SelectViewsStage{.view = listed.views});
  const auto planned =
      plan.Add(PlanDepthsStage{.manifest = manifest, .model = model, .chosen = chosen.chosen});
  const auto estimated = plan.Add(EstimateDepthsStage{.depth = planned.depths});
  const auto checks = plan.Add(ListChecksStage{.plan = planned.plan, .maps = estimated.map});
  const auto checked = plan.Add(CheckDepthsStage{.check = checks.checks});
  const auto fusions = plan.Add(ListFusionsStage{.plan = planned.plan, .maps = checked.map});
  const auto fused = plan.Add(FusePanoramaStage{.fusion = fusions.fusions});
  const auto tiles = plan.Add(ListTilesStage{.runs = fused.runs});
  plan.Add(AssembleTileStage{.recipe = tiles.tiles});
}

JobPlan DensePlanOf() {
  PlanBuilder plan(DenseJob::kKind);
  const auto job = InputsOf<DenseJob>();
  AddDenseStages(job.manifest, job.model, plan);
  return std::move(plan).Finish();
}

/// From `Job` by its first stages to verified images, and on to the model.
template <typename Job>
JobPlan PlanOf(VerifiedImages (*add_first_stages)(const Job&, PlanBuilder&)) {
  PlanBuilder plan(Job::kKind);
  AddModelStages(add_first_stages(InputsOf<Job>(), plan), plan);
  return std::move(plan).Finish();
}

}  // namespace

absl::StatusOr<JobPlan> FindJobPlan(std::string_view kind) {
  if (kind == SparseJob::kKind) return PlanOf<SparseJob>(AddImageStages);
  if (kind == SparseFromMatchesJob::kKind) return PlanOf<SparseFromMatchesJob>(AddVerification);
  if (kind == DenseJob::kKind) return DensePlanOf();
  return absl::NotFoundError(absl::StrCat("there is no job kind '",
                                          std::string(kind),
                                          "' (known: ",
                                          absl::StrJoin(JobKinds(), ", "),
                                          ")"));
}

std::vector<std::string> JobKinds() {
  return {std::string(SparseJob::kKind),
          std::string(SparseFromMatchesJob::kKind),
          std::string(DenseJob::kKind)};
}

}  // namespace orbweave
