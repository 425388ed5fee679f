// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/recipes.h"
#include "core/scene/carrier.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"
#include "stages/stage.h"

namespace orbweave {

/// Where images are and what they look like -> the pairs to try, and when (ListPairCandidates), and
/// what goes along with the cameras (FindCarriers).
struct SelectImagePairsStage {
  static constexpr StageFacts kFacts{.name = "select_image_pairs", .version = "8", .weight = 3.0};
  using Options = OptionSections<PairOptions, RetrievalOptions>;

  One<ImageManifest> manifest;
  Interleaved<Features, PlaceSample> features;  ///< samples, and features of a few of each drive

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &SelectImagePairsStage::manifest);
    visit("features", &SelectImagePairsStage::features);
  }

  struct Outputs {
    using Stage = SelectImagePairsStage;
    One<PairCandidates> candidates{};
    One<std::vector<Carrier>> carriers{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("candidates", &Outputs::candidates);
      visit("carriers", &Outputs::carriers);
    }
  };

  static absl::Status Run(StageTask<SelectImagePairsStage>& task);
};

}  // namespace orbweave
