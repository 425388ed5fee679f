// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "worker/image_stages.h"

#include <map>
#include <nlohmann/json.hpp>

#include "core/features/extract_features.h"
#include "core/features/retrieve_images.h"
#include "core/graph/select_image_pairs.h"
#include "core/stages/ingest_images.h"
#include "core/stages/match_image_pair.h"
#include "core/stages/pair_seed.h"
#include "core/stages/plan_recipes.h"
#include "proto/codec/features_codec.h"
#include "proto/codec/manifest_codec.h"
#include "proto/codec/recipes_codec.h"
#include "proto/codec/two_view_codec.h"
#include "worker/stage_io.h"

namespace orbweave {
namespace {

/// Few enough that a lost task costs seconds, enough that neighbours share their Features.
constexpr size_t kPairsPerTask = 16;

absl::StatusOr<std::string> GetOptional(const Digest& digest, BlobAccess& blobs) {
  if (digest.IsZero()) return std::string();
  return blobs.Get(digest);
}

/// The most similar images by place samples; `manifest` says which images know where they are.
absl::StatusOr<std::vector<std::vector<ImageId>>> SimilarImages(
    const std::vector<PlaceSample>& places,
    const ImageManifest& manifest,
    const RetrievalOptions& options,
    const StageContext& context) {
  std::vector<std::vector<uint8_t>> samples;
  samples.reserve(places.size());
  for (const PlaceSample& place : places) samples.push_back(place.descriptors);
  ORBWEAVE_ASSIGN_OR_RETURN(std::vector<std::vector<ImageId>> similar,
                            RetrieveSimilarImages(samples, options, context));
  for (const ImageRecord& image : manifest.images) {
    // Where GNSS tells the neighbours, appearance has nothing to add but repeated facades.
    if (image.prior.position_in_enu) similar[image.id.value].clear();
  }
  return similar;
}

struct LoadedImage {
  Features features{};
  std::vector<Eigen::Vector3d> bearings{};
  Digest digest{};
};

absl::StatusOr<std::map<ImageId, LoadedImage>> LoadImages(const std::vector<FeatureFile>& files,
                                                          BlobAccess& blobs) {
  std::map<ImageId, LoadedImage> images;
  for (const FeatureFile& file : files) {
    ORBWEAVE_ASSIGN_OR_RETURN(Features features, FetchBlob(file.features, blobs, DecodeFeatures));
    std::vector<Eigen::Vector3d> bearings = BearingsOf(features);
    images[file.image] = {std::move(features), std::move(bearings), file.features};
  }
  return images;
}

/// Seeded by the two images' content: the same pair gives the same answer in any task.
StageContext PairContext(const StageContext& context, const LoadedImage& a, const LoadedImage& b) {
  StageContext pair_context = context;
  pair_context.seed = PairSeed(a.digest, b.digest);
  return pair_context;
}

bool MatchesExist(const MatchRecipe::Pair& pair, const LoadedImage& a, const LoadedImage& b) {
  return std::all_of(pair.matches.begin(), pair.matches.end(), [&](const FeatureMatch& match) {
    return match.a < a.features.size() && match.b < b.features.size();
  });
}

}  // namespace

absl::StatusOr<TaskResult> RunIngestImages(const TaskSpec& spec,
                                           BlobAccess& blobs,
                                           const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageSources sources,
                            FetchInput(spec, 0, blobs, DecodeImageSources));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            IngestImages(sources, options.ingest, context));
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeImageManifest(manifest), blobs, result));
  ORBWEAVE_RETURN_IF_ERROR(
      PutRecipes(PlanExtraction(manifest), EncodeExtractRecipe, blobs, result));
  result.report_json =
      nlohmann::json{{"images", manifest.images.size()}, {"excluded", manifest.excluded.size()}}
          .dump();
  return result;
}

absl::StatusOr<TaskResult> RunExtractFeatures(const TaskSpec& spec,
                                              BlobAccess& blobs,
                                              const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ExtractRecipe recipe,
                            FetchInput(spec, 0, blobs, DecodeExtractRecipe));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string image, blobs.Get(recipe.image));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string mask, GetOptional(recipe.mask, blobs));
  const ExtractInput input{.name = "panorama",
                           .encoded_image = image,
                           .encoded_mask = mask,
                           .mask_ignores_white = recipe.mask_ignores_white};
  ORBWEAVE_ASSIGN_OR_RETURN(const Features features,
                            ExtractFeatures(input, options.features, context));
  const PlaceSample place{.num_features = static_cast<uint32_t>(features.size()),
                          .descriptors = SampleDescriptors(features, options.retrieval),
                          .problem = features.problem};
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeFeatures(features), blobs, result));
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodePlaceSample(place), blobs, result));
  result.report_json =
      nlohmann::json{{"features", features.size()}, {"problem", features.problem}}.dump();
  return result;
}

absl::StatusOr<TaskResult> RunSelectImagePairs(const TaskSpec& spec,
                                               BlobAccess& blobs,
                                               const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            FetchInput(spec, 0, blobs, DecodeImageManifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const ExtractedBlobs extracted,
                            FetchInput(spec, 1, blobs, SplitExtracted));
  if (extracted.features.size() != manifest.images.size()) {
    return absl::InvalidArgumentError("select_image_pairs: one Features blob per image is needed");
  }
  std::vector<PlaceSample> places;
  for (const Digest& digest : extracted.places) {
    ORBWEAVE_ASSIGN_OR_RETURN(PlaceSample place, FetchBlob(digest, blobs, DecodePlaceSample));
    places.push_back(std::move(place));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::vector<ImageId>> similar,
                            SimilarImages(places, manifest, options.retrieval, context));
  const std::vector<ImagePair> selected = SelectImagePairs(manifest, similar, options.pairs);
  std::vector<MatchRecipe::Pair> pairs;
  for (const ImagePair& pair : selected) {
    if (places[pair.a.value].num_features > 0 && places[pair.b.value].num_features > 0)
      pairs.push_back({pair, {}});
  }
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutRecipes(
      PlanMatching(pairs, extracted.features, kPairsPerTask), EncodeMatchRecipe, blobs, result));
  result.report_json = nlohmann::json{{"pairs", pairs.size()}}.dump();
  return result;
}

absl::StatusOr<TaskResult> RunMatchImages(const TaskSpec& spec,
                                          BlobAccess& blobs,
                                          const StageContext& context) {
  ORBWEAVE_ASSIGN_OR_RETURN(const PipelineOptions options, OptionsOf(spec));
  ORBWEAVE_ASSIGN_OR_RETURN(const MatchRecipe recipe,
                            FetchInput(spec, 0, blobs, DecodeMatchRecipe));
  ORBWEAVE_ASSIGN_OR_RETURN(const auto images, LoadImages(recipe.images, blobs));
  std::vector<TwoViewGeometry> verified;
  size_t putative = 0;
  size_t done = 0;
  for (const MatchRecipe::Pair& pair : recipe.pairs) {
    const LoadedImage& a = images.at(pair.pair.a);
    const LoadedImage& b = images.at(pair.pair.b);
    if (!MatchesExist(pair, a, b)) {
      return absl::InvalidArgumentError(
          "match_images: a match names a keypoint that its image does not have");
    }
    ORBWEAVE_ASSIGN_OR_RETURN(TwoViewGeometry geometry,
                              MatchImagePair(pair.pair,
                                             {a.features, a.bearings},
                                             {b.features, b.bearings},
                                             pair.matches,
                                             options.matching,
                                             options.two_view,
                                             PairContext(context, a, b)));
    putative += geometry.num_putative;
    if (geometry.kind != TwoViewKind::kNone) verified.push_back(std::move(geometry));
    context.Report(++done, recipe.pairs.size(), "pairs");
  }
  TaskResult result;
  ORBWEAVE_RETURN_IF_ERROR(PutOutput(EncodeTwoViewGeometries(verified), blobs, result));
  result.report_json = nlohmann::json{
      {"pairs", recipe.pairs.size()},
      {"verified", verified.size()},
      {"putative",
       putative}}.dump();
  return result;
}

}  // namespace orbweave
