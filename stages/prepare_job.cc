// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/prepare_job.h"

#include <filesystem>
#include <set>
#include <utility>

#include "core/graph/set_aside_far_pairs.h"
#include "core/io/colmap/read_colmap_database.h"
#include "core/io/images/cluster_table.h"
#include "core/io/printable_text.h"
#include "core/io/text_file.h"
#include "stages/check_options_together.h"
#include "stages/codecs.h"
#include "stages/ingest_images/ingest_images.h"
#include "stages/list_pairs/plan_matching.h"
#include "stages/offer_files.h"
#include "stages/plans.h"
#include "stages/stage_task.h"

namespace orbweave {
namespace {

constexpr size_t kPairsPerVerification = 256;

/// A database knows keypoints: one pixel of angular sigma, no descriptors, no colours.
Features FeaturesOf(const EquirectangularCamera& camera, std::vector<Keypoint> keypoints) {
  Features features{.camera = camera, .keypoints = std::move(keypoints)};
  features.sigma_rad.assign(features.size(), static_cast<float>(camera.AngleFromPixels(1.0)));
  features.colors.assign(features.size(), Rgb{128, 128, 128});
  return features;
}

absl::StatusOr<std::vector<Digest>> PutFeatures(BlobDepot& depot,
                                                std::vector<DatabaseImage> images) {
  std::vector<Digest> blobs;
  for (DatabaseImage& image : images) {
    const PlaceSample place{.num_features = static_cast<uint32_t>(image.keypoints.size())};
    const Features of_image = FeaturesOf(image.camera, std::move(image.keypoints));
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest features, PutBlob(of_image, depot));
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest sample, PutBlob(place, depot));
    blobs.insert(blobs.end(), {features, sample});
  }
  return blobs;
}

absl::StatusOr<std::vector<Digest>> PutMatches(BlobDepot& depot,
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
       PlanMatching(std::move(pairs), features, {}, kPairsPerVerification)) {
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, PutBlob(recipe, depot));
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
std::string LabelOf(const std::string& images) {
  std::filesystem::path path = std::filesystem::path(images).lexically_normal();
  if (path.filename().empty()) path = path.parent_path();
  if (path.filename() == "images") path = path.parent_path();
  return Utf8Text(path.filename().string());
}

}  // namespace

absl::StatusOr<JobSpec> PrepareImageJob(BlobDepot& depot,
                                        const ScanRequest& request,
                                        const std::string& cluster_table,
                                        const PipelineOptions& options,
                                        const StageContext& context) {
  return PrepareImageJob(depot, FoldersOf(request), request, cluster_table, options, context);
}

absl::StatusOr<JobSpec> PrepareImageJob(BlobDepot& depot,
                                        const ImagePlaces& places,
                                        const ScanRequest& request,
                                        const std::string& cluster_table,
                                        const PipelineOptions& options,
                                        const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageSources sources, ScanImagePlaces(places, request, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const ClusterNames by_hand, ReadClusters(sources, cluster_table));
  ORBWEAVE_RETURN_IF_ERROR(CheckOptionsTogether(options, ShapeOf(sources, by_hand, false)));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest clusters, PutBlob(by_hand, depot));
  ORBWEAVE_RETURN_IF_ERROR(OfferFiles(depot, sources, places, context));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest blob, PutBlob(sources, depot));
  JobInputs<SparseJob> inputs;
  inputs.Set(&SparseJob::sources, blob).Set(&SparseJob::clusters_by_hand, clusters);
  return JobSpec{.kind = std::string(SparseJob::kKind),
                 .inputs = inputs.InOrder(),
                 .options_text = PipelineOptionsToText(options),
                 .label = LabelOf(places.images->Name())};
}

absl::StatusOr<JobSpec> PrepareDatabaseJob(BlobDepot& depot,
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
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest clusters, PutBlob(by_hand, depot));
  ORBWEAVE_ASSIGN_OR_RETURN(ImageManifest manifest, IngestImages(sources, options.ingest, context));
  SetAsideFarPairs(options.pairs, manifest, database.pairs);
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> features,
                            PutFeatures(depot, std::move(database.images)));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> recipes,
                            PutMatches(depot, std::move(database.pairs), features));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest manifest_blob, PutBlob(manifest, depot));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest feature_list, PutBlob(features, depot));
  ORBWEAVE_ASSIGN_OR_RETURN(const Digest recipe_list, PutBlob(recipes, depot));
  using Job = SparseFromMatchesJob;
  JobInputs<Job> inputs;
  inputs.Set(&Job::manifest, manifest_blob)
      .Set(&Job::features, feature_list)
      .Set(&Job::runs, recipe_list)
      .Set(&Job::clusters_by_hand, clusters);
  return JobSpec{.kind = std::string(Job::kKind),
                 .inputs = inputs.InOrder(),
                 .options_text = PipelineOptionsToText(options),
                 .label = Utf8Text(std::filesystem::path(database_path).filename().string())};
}

}  // namespace orbweave
