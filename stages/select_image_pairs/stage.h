// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/recipes.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"
#include "stages/stage.h"

namespace orbweave {

/// Where images are and what they look like -> the pairs to try, and when (ListPairCandidates).
struct SelectImagePairsStage {
  static constexpr StageFacts kFacts{.name = "select_image_pairs", .version = "5", .weight = 3.0};
  using Options = OptionSections<PairOptions, RetrievalOptions>;

  One<ImageManifest> manifest;
  Interleaved<Features, PlaceSample> features;  ///< the samples alone are opened

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &SelectImagePairsStage::manifest);
    visit("features", &SelectImagePairsStage::features);
  }

  struct Outputs {
    using Stage = SelectImagePairsStage;
    One<PairCandidates> candidates{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("candidates", &Outputs::candidates);
    }
  };

  static absl::Status Run(StageTask<SelectImagePairsStage>& task);
};

}  // namespace orbweave
