// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fetch_results.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/pipeline/job_plan.h"
#include "proto/codec/adjustment_codec.h"
#include "proto/codec/block_codec.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/reconstruction_codec.h"
#include "proto/codec/two_view_codec.h"

namespace orbweave {
namespace {

constexpr const char* kFromMatches = "sparse_from_matches";

/// All outputs of a stage, in part order.
std::vector<Digest> OutputsOf(const std::vector<TaskOutcome>& outcomes, std::string_view stage) {
  std::vector<Digest> outputs;
  for (const TaskOutcome& outcome : outcomes) {
    if (outcome.stage != stage) continue;
    outputs.insert(outputs.end(), outcome.result.outputs.begin(), outcome.result.outputs.end());
  }
  return outputs;
}

/// The first output of each part of a stage, in part order.
std::vector<Digest> FirstOutputsOf(const std::vector<TaskOutcome>& outcomes,
                                   std::string_view stage) {
  std::vector<Digest> outputs;
  for (const TaskOutcome& outcome : outcomes) {
    if (outcome.stage == stage && !outcome.result.outputs.empty())
      outputs.push_back(outcome.result.outputs.front());
  }
  return outputs;
}

template <typename Decode>
auto FetchOne(CoordinatorApi& coordinator,
              const std::vector<TaskOutcome>& outcomes,
              std::string_view stage,
              Decode decode) -> decltype(decode(std::string_view())) {
  const std::vector<Digest> outputs = OutputsOf(outcomes, stage);
  if (outputs.empty())
    return absl::NotFoundError("the job has no result of stage " + std::string(stage));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(outputs.front()));
  return decode(bytes);
}

/// Blobs of Features and PlaceSample, alternating.
absl::StatusOr<std::vector<Digest>> ExtractedBlobs(CoordinatorApi& coordinator,
                                                   const JobSpec& job,
                                                   const std::vector<TaskOutcome>& outcomes) {
  if (job.kind != kFromMatches) return OutputsOf(outcomes, "extract_features");
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(job.inputs[1]));
  return DecodeCollection(bytes);
}

std::vector<std::string> ImageProblems(const std::vector<TaskOutcome>& outcomes) {
  std::vector<std::string> problems;
  for (const TaskOutcome& outcome : outcomes) {
    if (outcome.stage != "extract_features") continue;
    const auto report = nlohmann::json::parse(outcome.result.report_json, nullptr, false);
    const bool has_text = report.contains("problem") && report["problem"].is_string();
    problems.push_back(has_text ? report["problem"].get<std::string>() : "");
  }
  return problems;
}

absl::StatusOr<std::vector<ClusterSummary>> FetchClusters(
    CoordinatorApi& coordinator, const std::vector<TaskOutcome>& outcomes) {
  std::vector<ClusterSummary> clusters;
  for (const Digest& digest : FirstOutputsOf(outcomes, "reconstruct_cluster")) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(digest));
    ORBWEAVE_ASSIGN_OR_RETURN(const ClusterResult cluster, DecodeClusterResult(bytes));
    clusters.push_back(SummariseCluster(cluster));
  }
  return clusters;
}

/// Measures a model, and shows it to `listener`, one block after the other.
absl::StatusOr<AdjustedModel> FetchModel(CoordinatorApi& coordinator,
                                         const ConcludedWorld& world,
                                         const std::vector<Digest>& blocks,
                                         const ImageManifest& manifest,
                                         ModelListener* listener) {
  AdjustedModel model{.images = ModelImages(world), .report = world.report};
  ReconstructionMeter meter(model.images, manifest);
  const auto visit = [&](const Track& track) {
    meter.Add(track);
    if (listener != nullptr) listener->TakePoint(track);
  };
  if (listener != nullptr) listener->BeginModel(model.images, manifest);
  TracksOfWorld tracks(world);
  for (const Digest& digest : blocks) {
    ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(digest));
    ORBWEAVE_ASSIGN_OR_RETURN(WorldBlock block, DecodeWorldBlock(bytes));
    tracks.Add(std::move(block), visit);
  }
  tracks.Finish(visit);
  if (listener != nullptr) ORBWEAVE_RETURN_IF_ERROR(listener->EndModel());
  model.measures = std::move(meter).Finish();
  return model;
}

}  // namespace

absl::StatusOr<ImageManifest> FetchManifest(CoordinatorApi& coordinator,
                                            const JobSpec& job,
                                            const std::vector<TaskOutcome>& outcomes) {
  if (job.kind != kFromMatches)
    return FetchOne(coordinator, outcomes, "ingest_images", DecodeImageManifest);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(job.inputs[0]));
  return DecodeImageManifest(bytes);
}

absl::StatusOr<JobResults> FetchResults(CoordinatorApi& coordinator,
                                        const JobSpec& job,
                                        const std::vector<TaskOutcome>& outcomes,
                                        ModelListener* listener) {
  JobResults results;
  ORBWEAVE_ASSIGN_OR_RETURN(results.manifest, FetchManifest(coordinator, job, outcomes));
  results.image_problems = ImageProblems(outcomes);
  ORBWEAVE_ASSIGN_OR_RETURN(
      results.view_graph,
      FetchOne(coordinator, outcomes, "partition_view_graph", DecodeDividedViewGraph));
  ORBWEAVE_ASSIGN_OR_RETURN(results.clusters, FetchClusters(coordinator, outcomes));
  ORBWEAVE_ASSIGN_OR_RETURN(results.alignment,
                            FetchOne(coordinator, outcomes, "align_submodels", DecodeAlignment));
  ORBWEAVE_ASSIGN_OR_RETURN(results.review,
                            FetchOne(coordinator, outcomes, "review_seams", DecodePartitionReview));
  ORBWEAVE_ASSIGN_OR_RETURN(
      const ConcludedModel model,
      FetchOne(coordinator, outcomes, "conclude_adjustment", DecodeConcludedModel));
  for (size_t world = 0; world < model.worlds.size(); ++world) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        results.models.emplace_back(),
        FetchModel(
            coordinator, model.worlds[world], model.blocks[world], results.manifest, listener));
    const std::vector<SeamCertificate>& seams = model.worlds[world].seams;
    results.certificates.insert(results.certificates.end(), seams.begin(), seams.end());
  }
  return results;
}

absl::StatusOr<std::vector<Digest>> FetchFeatureNames(CoordinatorApi& coordinator,
                                                      const JobSpec& job,
                                                      const std::vector<TaskOutcome>& outcomes) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> blobs,
                            ExtractedBlobs(coordinator, job, outcomes));
  std::vector<Digest> names;
  for (size_t i = 0; i < blobs.size(); i += 2) names.push_back(blobs[i]);
  return names;
}

absl::StatusOr<Features> FetchFeatures(CoordinatorApi& coordinator, const Digest& name) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(name));
  return DecodeFeatures(bytes);
}

absl::StatusOr<std::vector<TwoViewGeometry>> FetchVerifiedPairs(
    CoordinatorApi& coordinator, const std::vector<TaskOutcome>& outcomes) {
  std::vector<TwoViewGeometry> pairs;
  for (const char* stage : {"match_images", "verify_matches"}) {
    for (const Digest& digest : OutputsOf(outcomes, stage)) {
      ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, coordinator.Get(digest));
      ORBWEAVE_ASSIGN_OR_RETURN(std::vector<TwoViewGeometry> part, DecodeTwoViewGeometries(bytes));
      std::move(part.begin(), part.end(), std::back_inserter(pairs));
    }
  }
  std::sort(
      pairs.begin(), pairs.end(), [](const auto& x, const auto& y) { return x.pair < y.pair; });
  return pairs;
}

}  // namespace orbweave
