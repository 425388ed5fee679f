// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/recipes.h"
#include "core/scene/features.h"
#include "stages/stage.h"

namespace orbweave {

/// One image and its mask -> its features (ExtractFeatures), and a sample of their descriptors by
/// which the place is recognised.
struct ExtractFeaturesStage {
  static constexpr StageFacts kFacts{.name = "extract_features", .version = "4", .weight = 30.0};
  using Options = OptionSections<ExtractOptions, RetrievalOptions>;

  Parts<ExtractRecipe> image;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("image", &ExtractFeaturesStage::image);
  }

  struct Outputs {
    using Stage = ExtractFeaturesStage;
    EachPart<Features> features{};
    EachPart<PlaceSample> places{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("features", &Outputs::features);
      visit("places", &Outputs::places);
    }
  };

  static absl::Status Run(StageTask<ExtractFeaturesStage>& task);
};

}  // namespace orbweave
