// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/select_image_pairs/stage.h"

#include <nlohmann/json.hpp>

#include "core/features/retrieve_images.h"
#include "core/graph/list_pair_candidates.h"
#include "stages/codecs.h"
#include "stages/select_image_pairs/find_carriers.h"

namespace orbweave {
namespace {

/// The most similar images by place samples, as many as the reserve asks for.
absl::StatusOr<std::vector<std::vector<ImageId>>> SimilarImages(
    const std::vector<PlaceSample>& places,
    RetrievalOptions options,
    const PairOptions& pairs,
    const StageContext& context) {
  std::vector<std::vector<uint8_t>> samples;
  samples.reserve(places.size());
  for (const PlaceSample& place : places) samples.push_back(place.descriptors);
  if (pairs.first_neighbours > 0 && pairs.thin_below > 0) options.num_neighbours *= kReserveFactor;
  return RetrieveSimilarImages(samples, options, context);
}

void RemoveBlindImages(const std::vector<PlaceSample>& places, std::vector<ImagePair>& pairs) {
  std::erase_if(pairs, [&](const ImagePair& pair) {
    return places[pair.a.value].num_features == 0 || places[pair.b.value].num_features == 0;
  });
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
  const RetrievalOptions& retrieval = task.options<RetrievalOptions>();
  const PairOptions& options = task.options<PairOptions>();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<std::vector<ImageId>> similar,
                            SimilarImages(places, retrieval, options, task.context()));
  PairCandidates candidates =
      ListPairCandidates(manifest, similar, retrieval.num_neighbours, options);
  for (std::vector<ImagePair>* pairs : {&candidates.first, &candidates.second, &candidates.reserve})
    RemoveBlindImages(places, *pairs);
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::candidates, candidates).status());
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Carrier> carriers,
                            FindCarriers(manifest, [&](ImageId id) {
                              return task.Fetch<Features>(features.first[id.value]);
                            }));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::carriers, carriers).status());
  task.Report(nlohmann::json{{"first", candidates.first.size()},
                             {"second", candidates.second.size()},
                             {"reserve", candidates.reserve.size()},
                             {"carriers", carriers.size()}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
