// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/recipes.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"
#include "stages/stage.h"

namespace orbweave {

/// Which images take part -> what to find features in, and whether in facade views too: as
/// positions tell (WantsFacades), or as the first pairs have shown. A recipe of an earlier round is
/// the same again, whose result is known.
struct ListExtractionsStage {
  static constexpr StageFacts kFacts{.name = "list_extractions", .version = "1", .weight = 0.1};
  using Options = OptionSections<ExtractOptions>;

  One<ImageManifest> manifest;
  RoundBefore<One<WiderPairs>> wider;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &ListExtractionsStage::manifest);
    visit("wider", &ListExtractionsStage::wider);
  }

  struct Outputs {
    using Stage = ListExtractionsStage;
    Parts<ExtractRecipe> images{};  ///< in id order

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("images", &Outputs::images);
    }
  };

  static absl::Status Run(StageTask<ListExtractionsStage>& task);
};

}  // namespace orbweave
