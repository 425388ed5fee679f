// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/recipes.h"
#include "core/io/images/image_sources.h"
#include "core/scene/image_manifest.h"
#include "stages/stage.h"

namespace orbweave {

/// What a folder holds -> which images take part, and what is known of each (IngestImages).
/// ExtractOptions say whether facades are wanted (WantsFacades).
struct IngestImagesStage {
  static constexpr StageFacts kFacts{.name = "ingest_images", .version = "7", .weight = 1.0};
  using Options = OptionSections<IngestOptions, ExtractOptions>;

  One<ImageSources> sources;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("sources", &IngestImagesStage::sources);
  }

  struct Outputs {
    using Stage = IngestImagesStage;
    One<ImageManifest> manifest{};
    Parts<ExtractRecipe> images{};  ///< in id order

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("manifest", &Outputs::manifest);
      visit("images", &Outputs::images);
    }
  };

  static absl::Status Run(StageTask<IngestImagesStage>& task);
};

}  // namespace orbweave
