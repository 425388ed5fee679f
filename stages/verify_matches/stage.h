// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/recipes.h"
#include "core/scene/two_view_geometry.h"
#include "stages/stage.h"

namespace orbweave {

/// MatchImagesStage on matches that are given: descriptors have no say in it.
struct VerifyMatchesStage {
  static constexpr StageFacts kFacts{.name = "verify_matches", .version = "11", .weight = 10.0};
  using Options = OptionSections<TwoViewOptions>;

  Parts<MatchRecipe> run;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("run", &VerifyMatchesStage::run);
  }

  struct Outputs {
    using Stage = VerifyMatchesStage;
    EachPart<std::vector<TwoViewGeometry>> verified{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("verified", &Outputs::verified);
    }
  };

  static absl::Status Run(StageTask<VerifyMatchesStage>& task);
};

}  // namespace orbweave
