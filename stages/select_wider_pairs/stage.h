// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/image_manifest.h"
#include "core/scene/pair_candidates.h"
#include "stages/stage.h"

namespace orbweave {

/// What the pairs so far have shown -> whether to match them by features of facade views too
/// (SeeFewOthers, where features.facades leaves that open), then which others to match as well
/// (ChooseWiderPairs). As long as anything is asked for, another round begins.
struct SelectWiderPairsStage {
  static constexpr StageFacts kFacts{.name = "select_wider_pairs", .version = "5", .weight = 0.1};
  using Options = OptionSections<PairOptions, ExtractOptions>;

  One<ImageManifest> manifest;
  One<PairCandidates> candidates;
  EachPart<std::vector<MatchedPair>> matched;
  RoundBefore<One<WiderPairs>> before;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &SelectWiderPairsStage::manifest);
    visit("candidates", &SelectWiderPairsStage::candidates);
    visit("matched", &SelectWiderPairsStage::matched);
    visit("before", &SelectWiderPairsStage::before);
  }

  struct Outputs {
    using Stage = SelectWiderPairsStage;
    One<WiderPairs> wider{};
    Parts<WiderPairs> another_round{};  ///< the same, or none

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("wider", &Outputs::wider);
      visit("another_round", &Outputs::another_round);
    }
  };

  static absl::Status Run(StageTask<SelectWiderPairsStage>& task);
};

}  // namespace orbweave
