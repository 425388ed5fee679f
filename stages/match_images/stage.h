// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/recipes.h"
#include "core/scene/pair_candidates.h"
#include "core/scene/two_view_geometry.h"
#include "stages/stage.h"

namespace orbweave {

/// A run of pairs -> those that have a geometry, with their matches (MatchImagePair).
struct MatchImagesStage {
  static constexpr StageFacts kFacts{.name = "match_images", .version = "19", .weight = 25.0};
  using Options = OptionSections<MatchOptions, TwoViewOptions>;

  Parts<MatchRecipe> run;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("run", &MatchImagesStage::run);
  }

  struct Outputs {
    using Stage = MatchImagesStage;
    EachPart<std::vector<TwoViewGeometry>> verified{};
    EachPart<std::vector<MatchedPair>> matched{};  ///< what `verified` says without its matches

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("verified", &Outputs::verified);
      visit("matched", &Outputs::matched);
    }
  };

  static absl::Status Run(StageTask<MatchImagesStage>& task);
};

}  // namespace orbweave
