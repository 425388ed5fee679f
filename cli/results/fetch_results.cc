// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/results/fetch_results.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/partitioned_ba/adjust_subproblems.h"
#include "core/report/build_job_report.h"
#include "core/report/check_results.h"
#include "stages/align_submodels/stage.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/extract_features/stage.h"
#include "stages/job_reader.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plans.h"
#include "stages/reconstruct_cluster/stage.h"
#include "stages/review_seams/stage.h"
#include "stages/select_image_pairs/stage.h"
#include "stages/select_wider_pairs/stage.h"

namespace orbweave {
namespace {

std::vector<std::string> ImageProblems(const JobReader& job) {
  std::vector<std::string> problems;
  for (const std::string& text : job.Reports<ExtractFeaturesStage>()) {
    const auto report = nlohmann::json::parse(text, nullptr, false);
    const bool has_text = report.contains("problem") && report["problem"].is_string();
    problems.push_back(has_text ? report["problem"].get<std::string>() : "");
  }
  return problems;
}

/// Not by a job on given matches.
bool SelectsPairs(const JobPlan& plan) {
  const std::string_view stage = SelectImagePairsStage::kFacts.name;
  return std::ranges::find(plan.stages, stage, &StageRule::stage) != plan.stages.end();
}

absl::StatusOr<std::optional<WiderPairs>> FetchWiderPairs(const JobPlan& plan, JobReader& job) {
  if (!SelectsPairs(plan)) return std::nullopt;
  return job.Read(&SelectWiderPairsStage::Outputs::wider);
}

absl::StatusOr<std::vector<Carrier>> ReadCarriers(const JobPlan& plan, JobReader& job) {
  if (!SelectsPairs(plan)) return std::vector<Carrier>{};
  return job.Read(&SelectImagePairsStage::Outputs::carriers);
}

absl::StatusOr<std::vector<ClusterSummary>> FetchClusters(JobReader& job) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests,
                            job.List(&ReconstructClusterStage::Outputs::whole));
  std::vector<ClusterSummary> clusters;
  for (const Digest& digest : digests) {
    ORBWEAVE_ASSIGN_OR_RETURN(const ClusterResult cluster, job.Fetch<ClusterResult>(digest));
    clusters.push_back(SummariseCluster(cluster));
  }
  return clusters;
}

/// Measures a model, and shows it to `listener`, one subproblem after the other.
absl::StatusOr<AdjustedModel> FetchModel(JobReader& job,
                                         const FinalisedWorld& world,
                                         const std::vector<Digest>& subproblems,
                                         const ImageManifest& manifest,
                                         ModelListener* listener) {
  AdjustedModel model{.images = ModelImages(world), .report = world.report};
  ORBWEAVE_RETURN_IF_ERROR(CheckModel(model.images, manifest));
  ReconstructionMeter meter(model.images, manifest);
  HingeFinder hinges(model.images);
  const auto visit = [&](const Track& track) {
    meter.Add(track);
    hinges.Add(track);
    if (listener != nullptr) listener->TakePoint(track);
  };
  if (listener != nullptr) listener->BeginModel(model.images, manifest);
  TracksOfWorld tracks(world);
  for (const Digest& digest : subproblems) {
    ORBWEAVE_ASSIGN_OR_RETURN(Subproblem subproblem, job.Fetch<Subproblem>(digest));
    tracks.Add(std::move(subproblem), visit);
  }
  tracks.Finish(visit);
  if (listener != nullptr) ORBWEAVE_RETURN_IF_ERROR(listener->EndModel());
  model.measures = std::move(meter).Finish();
  model.hinged_pieces = std::move(hinges).Finish();
  return model;
}

}  // namespace

absl::StatusOr<ImageManifest> FetchManifest(BlobAccess& coordinator,
                                            const JobSpec& job,
                                            const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader reader(plan, job, outcomes, coordinator);
  ORBWEAVE_ASSIGN_OR_RETURN(ImageManifest manifest,
                            reader.Read(&PartitionViewGraphStage::manifest));
  ORBWEAVE_RETURN_IF_ERROR(CheckManifest(manifest));
  return manifest;
}

absl::StatusOr<std::vector<Carrier>> FetchCarriers(BlobAccess& coordinator,
                                                   const JobSpec& job,
                                                   const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader reader(plan, job, outcomes, coordinator);
  return ReadCarriers(plan, reader);
}

absl::StatusOr<JobResults> FetchResults(BlobAccess& coordinator,
                                        const JobSpec& job,
                                        const std::vector<TaskOutcome>& outcomes,
                                        ModelListener* listener) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader reader(plan, job, outcomes, coordinator);
  JobResults results;
  ORBWEAVE_ASSIGN_OR_RETURN(results.manifest, reader.Read(&PartitionViewGraphStage::manifest));
  ORBWEAVE_RETURN_IF_ERROR(CheckManifest(results.manifest));
  results.image_problems = ImageProblems(reader);
  results.image_problems.resize(results.manifest.images.size());
  ORBWEAVE_ASSIGN_OR_RETURN(results.carriers, ReadCarriers(plan, reader));
  ORBWEAVE_RETURN_IF_ERROR(CheckCarriers(results.carriers, results.manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(results.wider_pairs, FetchWiderPairs(plan, reader));
  ORBWEAVE_ASSIGN_OR_RETURN(results.view_graph,
                            reader.Read(&PartitionViewGraphStage::Outputs::divided));
  const Partition& partition = results.view_graph.partition;
  ORBWEAVE_RETURN_IF_ERROR(CheckPartition(partition, results.manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(results.clusters, FetchClusters(reader));
  ORBWEAVE_RETURN_IF_ERROR(CheckClusters(results.clusters, partition, results.manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(results.alignment,
                            reader.Read(&AlignSubmodelsStage::Outputs::alignment));
  ORBWEAVE_RETURN_IF_ERROR(CheckAlignment(results.alignment, results.clusters));
  ORBWEAVE_ASSIGN_OR_RETURN(results.review, reader.Read(&ReviewSeamsStage::Outputs::review));
  ORBWEAVE_ASSIGN_OR_RETURN(const FinalisedModel model,
                            reader.Read(&ConcludeAdjustmentStage::Outputs::model));
  results.left_out = model.left_out;
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        results.models.emplace_back(),
        FetchModel(
            reader, model.worlds[world], model.subproblems[world], results.manifest, listener));
    const std::vector<SeamCertificate>& seams = model.worlds[world].seams;
    results.certificates.insert(results.certificates.end(), seams.begin(), seams.end());
  }
  return results;
}

absl::StatusOr<std::vector<Digest>> FetchFeatureNames(BlobAccess& coordinator,
                                                      const JobSpec& job,
                                                      const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  ORBWEAVE_ASSIGN_OR_RETURN(
      InterleavedDigests features,
      JobReader(plan, job, outcomes, coordinator).List(&PartitionViewGraphStage::features));
  return std::move(features.first);
}

absl::StatusOr<Features> FetchFeatures(BlobAccess& coordinator, const Digest& name) {
  return FetchBlob<Features>(name, coordinator);
}

absl::StatusOr<std::vector<TwoViewGeometry>> FetchVerifiedPairs(
    BlobAccess& coordinator, const JobSpec& job, const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const JobPlan plan, FindJobPlan(job.kind));
  JobReader reader(plan, job, outcomes, coordinator);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> digests,
                            reader.List(&PartitionViewGraphStage::verified));
  std::vector<TwoViewGeometry> pairs;
  for (const Digest& digest : digests) {
    ORBWEAVE_ASSIGN_OR_RETURN(auto part, reader.Fetch<std::vector<TwoViewGeometry>>(digest));
    std::move(part.begin(), part.end(), std::back_inserter(pairs));
  }
  std::ranges::sort(pairs, {}, &TwoViewGeometry::pair);
  return pairs;
}

}  // namespace orbweave
