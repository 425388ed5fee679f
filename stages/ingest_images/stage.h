// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/io/images/image_sources.h"
#include "core/scene/image_manifest.h"
#include "stages/stage.h"

namespace orbweave {

/// What a folder holds -> which images take part, and what is known of each (IngestImages).
struct IngestImagesStage {
  static constexpr StageFacts kFacts{.name = "ingest_images", .version = "8", .weight = 1.0};
  using Options = OptionSections<IngestOptions>;

  One<ImageSources> sources;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("sources", &IngestImagesStage::sources);
  }

  struct Outputs {
    using Stage = IngestImagesStage;
    One<ImageManifest> manifest{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("manifest", &Outputs::manifest);
    }
  };

  static absl::Status Run(StageTask<IngestImagesStage>& task);
};

}  // namespace orbweave
