// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/select_image_pairs/stage.h"

#include <nlohmann/json.hpp>

#include "core/features/retrieve_images.h"
#include "core/graph/select_image_pairs.h"
#include "stages/codecs.h"
#include "stages/select_image_pairs/plan_matching.h"

namespace orbweave {
namespace {

/// Few enough that a lost task costs seconds, enough that neighbours share their Features.
constexpr size_t kPairsPerTask = 16;

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

}  // namespace

absl::Status SelectImagePairsStage::Run(StageTask<SelectImagePairsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            task.Read(&SelectImagePairsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const InterleavedDigests features,
                            task.Read(&SelectImagePairsStage::features));
  if (features.first.size() != manifest.images.size()) {
    return absl::InvalidArgumentError("select_image_pairs: one Features blob per image is needed");
  }
  std::vector<PlaceSample> places;
  for (const Digest& digest : features.second) {
    ORBWEAVE_ASSIGN_OR_RETURN(places.emplace_back(), task.Fetch<PlaceSample>(digest));
  }
  ORBWEAVE_ASSIGN_OR_RETURN(
      const std::vector<std::vector<ImageId>> similar,
      SimilarImages(places, manifest, task.options<RetrievalOptions>(), task.context()));
  std::vector<MatchRecipe::Pair> pairs;
  for (const ImagePair& pair : SelectImagePairs(manifest, similar, task.options<PairOptions>())) {
    if (places[pair.a.value].num_features > 0 && places[pair.b.value].num_features > 0)
      pairs.push_back({pair, {}});
  }
  ORBWEAVE_RETURN_IF_ERROR(
      task.LeaveAll(&Outputs::runs, PlanMatching(pairs, features.first, kPairsPerTask)));
  task.Report(nlohmann::json{{"pairs", pairs.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
