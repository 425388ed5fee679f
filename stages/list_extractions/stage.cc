// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/list_extractions/stage.h"

#include <nlohmann/json.hpp>

#include "stages/codecs.h"
#include "stages/list_extractions/wants_facades.h"

namespace orbweave {

absl::Status ListExtractionsStage::Run(StageTask<ListExtractionsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            task.Read(&ListExtractionsStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const WiderPairs wider, task.Read(&ListExtractionsStage::wider));
  const bool wants_facades =
      wider.wants_facades || WantsFacades(manifest, task.options<ExtractOptions>());
  for (const ImageRecord& image : manifest.images) {
    ORBWEAVE_RETURN_IF_ERROR(task.Leave(
        &Outputs::images,
        ExtractRecipe{image.content, image.mask, manifest.mask_ignores_white, wants_facades}));
  }
  task.Report(
      nlohmann::json{{"images", manifest.images.size()}, {"facades", wants_facades}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
