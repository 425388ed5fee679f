// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/stage_results.h"
#include "core/merging/alignment/review_seams.h"
#include "stages/stage.h"

namespace orbweave {

/// What became of the seams -> which want more overlap (ReviewSeams). As long as any does, the
/// partition begins another round.
struct ReviewSeamsStage {
  static constexpr StageFacts kFacts{.name = "review_seams", .version = "1", .weight = 0.1};
  using Options = OptionSections<PartitionOptions>;

  One<DividedViewGraph> divided;
  One<Alignment> alignment;
  RoundBefore<One<PartitionReview>> before;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("divided", &ReviewSeamsStage::divided);
    visit("alignment", &ReviewSeamsStage::alignment);
    visit("before", &ReviewSeamsStage::before);
  }

  struct Outputs {
    using Stage = ReviewSeamsStage;
    One<PartitionReview> review{};
    Parts<PartitionReview> another_round{};  ///< the same, or none

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("review", &Outputs::review);
      visit("another_round", &Outputs::another_round);
    }
  };

  static absl::Status Run(StageTask<ReviewSeamsStage>& task);
};

}  // namespace orbweave
