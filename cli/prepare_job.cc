// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "cli/prepare_job.h"

#include <filesystem>
#include <set>
#include <utility>

#include "core/graph/set_aside_far_pairs.h"
#include "core/io/cluster_table.h"
#include "core/io/colmap_database.h"
#include "core/io/file.h"
#include "core/io/printable_text.h"
#include "core/io/text_file.h"
#include "core/pipeline/job_plan.h"
#include "core/stages/check_options_together.h"
#include "core/stages/ingest_images.h"
#include "core/stages/plan_recipes.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/recipes_codec.h"

namespace orbweave {
namespace {

constexpr size_t kPairsPerVerification = 256;

absl::Status OfferFile(CoordinatorApi& coordinator, const Digest& digest, const std::string& path) {
  const absl::Status linked = coordinator.LinkFile(digest, path);
  if (linked.ok() || absl::IsDataLoss(linked)) return linked;
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string bytes, ReadFile(path));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest stored, coordinator.Put(bytes));
  if (stored != digest) return absl::DataLossError(path + " changed while it was read; run again");
  return absl::OkStatus();
}

/// Every usable file and mask that the coordinator does not know yet.
absl::Status OfferFiles(CoordinatorApi& coordinator,
                        const ImageSources& sources,
                        const StageContext& context) {
  std::vector<Digest> digests;
  std::vector<std::string> paths;
  for (const SourceImage& image : sources.images) {
    if (!image.problem.empty()) continue;
    digests.push_back(image.content);
    paths.push_back(image.path);
    if (image.mask.IsZero()) continue;
    digests.push_back(image.mask);
    paths.push_back(image.mask_path);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<bool> known, coordinator.StatBlobs(digests));
  for (size_t i = 0; i < digests.size(); ++i) {
    ORBWEAVE_RETURN_IF_ERROR(context.CheckStop());
    if (!known[i]) ORBWEAVE_RETURN_IF_ERROR(OfferFile(coordinator, digests[i], paths[i]));
    context.Report(i + 1, digests.size(), "files");
  }
  return absl::OkStatus();
}

/// A database knows keypoints: one pixel of angular sigma, no descriptors, no colours.
Features FeaturesOf(const EquirectangularCamera& camera, std::vector<Keypoint> keypoints) {
  Features features{.camera = camera, .keypoints = std::move(keypoints)};
  features.sigma_rad.assign(features.size(), static_cast<float>(camera.AngleFromPixels(1.0)));
  features.colors.assign(features.size(), Rgb{128, 128, 128});
  return features;
}

absl::StatusOr<std::vector<Digest>> PutFeatures(CoordinatorApi& coordinator,
                                                std::vector<DatabaseImage> images) {
  std::vector<Digest> blobs;
  for (DatabaseImage& image : images) {
    const PlaceSample place{.num_features = static_cast<uint32_t>(image.keypoints.size())};
    const Features of_image = FeaturesOf(image.camera, std::move(image.keypoints));
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest features, coordinator.Put(EncodeFeatures(of_image)));
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest sample, coordinator.Put(EncodePlaceSample(place)));
    blobs.insert(blobs.end(), {features, sample});
  }
  return blobs;
}

absl::StatusOr<std::vector<Digest>> PutMatches(CoordinatorApi& coordinator,
                                               std::vector<TwoViewGeometry> verified,
                                               const std::vector<Digest>& feature_blobs) {
  std::vector<MatchRecipe::Pair> pairs;
  for (TwoViewGeometry& pair : verified) {
    if (!pair.inliers.empty()) pairs.push_back({pair.pair, std::move(pair.inliers)});
  }
  std::vector<Digest> features;
  for (size_t i = 0; i < feature_blobs.size(); i += 2) features.push_back(feature_blobs[i]);
  std::vector<Digest> recipes;
  for (const MatchRecipe& recipe :
       PlanMatching(std::move(pairs), features, kPairsPerVerification)) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, coordinator.Put(EncodeMatchRecipe(recipe)));
    recipes.push_back(digest);
  }
  return recipes;
}

/// The names of images that may take part.
std::vector<std::string> UsableNames(const ImageSources& sources) {
  std::vector<std::string> names;
  for (const SourceImage& image : sources.images) {
    if (image.problem.empty()) names.push_back(image.name);
  }
  return names;
}

/// Clusters by hand for the usable images; empty where no table is given.
absl::StatusOr<ClusterNames> ReadClusters(const ImageSources& sources,
                                          const std::string& cluster_table) {
  if (cluster_table.empty()) return ClusterNames{};
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(cluster_table));
  return ReadClusterTable(text, cluster_table, UsableNames(sources));
}

JobShape ShapeOf(const ImageSources& sources, const ClusterNames& clusters, bool has_matches) {
  std::set<std::string> by_hand;
  for (const auto& [image, cluster] : clusters) by_hand.insert(cluster);
  return {.num_images = UsableNames(sources).size(),
          .num_clusters_by_hand = by_hand.size(),
          .has_matches = has_matches};
}

/// The folder's name, or that of the folder above where it is just called "images".
std::string LabelOf(const std::string& image_folder) {
  std::filesystem::path path = std::filesystem::absolute(image_folder).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (path.filename() == "images") path = path.parent_path();
  return Utf8Text(path.filename().string());
}

}  // namespace

absl::StatusOr<JobSpec> PrepareImageJob(CoordinatorApi& coordinator,
                                        const ScanRequest& request,
                                        const std::string& cluster_table,
                                        const PipelineOptions& options,
                                        const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageSources sources, ScanImageFolder(request, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterNames by_hand, ReadClusters(sources, cluster_table));
  ORBWEAVE_RETURN_IF_ERROR(CheckOptionsTogether(options, ShapeOf(sources, by_hand, false)));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest clusters, coordinator.Put(EncodeClusterNames(by_hand)));
  ORBWEAVE_RETURN_IF_ERROR(OfferFiles(coordinator, sources, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest blob, coordinator.Put(EncodeImageSources(sources)));
  return JobSpec{.kind = "sparse",
                 .inputs = {blob, clusters},
                 .options_text = PipelineOptionsToText(options),
                 .label = LabelOf(request.image_folder)};
}

absl::StatusOr<JobSpec> PrepareDatabaseJob(CoordinatorApi& coordinator,
                                           const std::string& database_path,
                                           const std::string& gnss_table,
                                           const std::string& cluster_table,
                                           const PipelineOptions& options,
                                           const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(ColmapDatabase database, ReadColmapDatabase(database_path));
  ImageSources sources = SourcesFromDatabase(database);
  if (!gnss_table.empty()) {
    ORBWEAVE_RETURN_IF_ERROR(ReadGnssFile(gnss_table, sources));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterNames by_hand, ReadClusters(sources, cluster_table));
  ORBWEAVE_RETURN_IF_ERROR(CheckOptionsTogether(options, ShapeOf(sources, by_hand, true)));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest clusters, coordinator.Put(EncodeClusterNames(by_hand)));
  ORBWEAVE_ASSIGN_OR_RETURN(ImageManifest manifest, IngestImages(sources, options.ingest, context));
  SetAsideFarPairs(options.pairs, manifest, database.pairs);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> features,
                            PutFeatures(coordinator, std::move(database.images)));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> recipes,
                            PutMatches(coordinator, std::move(database.pairs), features));
  JobSpec job{.kind = "sparse_from_matches",
              .options_text = PipelineOptionsToText(options),
              .label = Utf8Text(std::filesystem::path(database_path).filename().string())};
  for (const std::string& bytes :
       {EncodeImageManifest(manifest), EncodeCollection(features), EncodeCollection(recipes)}) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, coordinator.Put(bytes));
    job.inputs.push_back(digest);
  }
  job.inputs.push_back(clusters);
  return job;
}

}  // namespace orbweave
