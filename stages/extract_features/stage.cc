// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/extract_features/stage.h"

#include <nlohmann/json.hpp>

#include "core/features/extract_features.h"
#include "core/features/retrieve_images.h"
#include "stages/codecs.h"
#include "stages/get_optional.h"

namespace orbweave {

absl::Status ExtractFeaturesStage::Run(StageTask<ExtractFeaturesStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ExtractRecipe recipe, task.Read(&ExtractFeaturesStage::image));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string image, task.blobs().Get(recipe.image));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::string mask, GetOptional(recipe.mask, task.blobs()));
  const ExtractInput input{.name = "panorama",
                           .encoded_image = image,
                           .encoded_mask = mask,
                           .mask_ignores_white = recipe.mask_ignores_white,
                           .wants_facades = recipe.wants_facades};
  ORBWEAVE_ASSIGN_OR_RETURN(const Features features,
                            ExtractFeatures(input, task.options<ExtractOptions>(), task.context()));
  const PlaceSample place{
      .num_features = static_cast<uint32_t>(features.size()),
      .descriptors = SampleDescriptors(features, task.options<RetrievalOptions>()),
      .problem = features.problem};
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::features, features).status());
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::places, place).status());
  task.Report(nlohmann::json{{"features", features.size()}, {"problem", features.problem}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
