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

/// The first candidates, and those asked for since -> all of them in runs (PlanMatching). A run of
/// an earlier round is the same recipe again, whose result is known.
struct ListPairsStage {
  static constexpr StageFacts kFacts{.name = "list_pairs", .version = "3", .weight = 0.1};
  using Options = OptionSections<>;

  One<PairCandidates> candidates;
  One<std::vector<Carrier>> carriers;
  Interleaved<Features, PlaceSample> features;  ///< only named
  RoundBefore<One<WiderPairs>> wider;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("candidates", &ListPairsStage::candidates);
    visit("carriers", &ListPairsStage::carriers);
    visit("features", &ListPairsStage::features);
    visit("wider", &ListPairsStage::wider);
  }

  struct Outputs {
    using Stage = ListPairsStage;
    Parts<MatchRecipe> runs{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("runs", &Outputs::runs);
    }
  };

  static absl::Status Run(StageTask<ListPairsStage>& task);
};

}  // namespace orbweave
