// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/partitioned_ba/subproblem.h"
#include "stages/stage.h"

namespace orbweave {

/// One round of the global adjustment: where all worlds stand, and what their subproblems answered
/// -> what to ask the subproblems next (AdvanceAdjustment). Worlds smaller than
/// blocks.distribute_from are adjusted here and now, by the same steps (AdjustSubproblems).
struct SteerAdjustmentStage {
  static constexpr StageFacts kFacts{.name = "steer_adjustment", .version = "5", .weight = 1.0};
  using Options = OptionSections<GlobalAdjustOptions, BundleOptions, DistributionOptions>;

  One<std::vector<JoinedWorld>> worlds;
  EachPart<Subproblem> subproblems;  ///< of all worlds, sorted by world
  RoundBefore<One<AdjustmentProgress>> before;
  RoundBefore<EachPart<SubproblemResult>> replies;  ///< in the order of `orders`

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("worlds", &SteerAdjustmentStage::worlds);
    visit("blocks", &SteerAdjustmentStage::subproblems);
    visit("before", &SteerAdjustmentStage::before);
    visit("answers", &SteerAdjustmentStage::replies);
  }

  struct Outputs {
    using Stage = SteerAdjustmentStage;
    One<AdjustmentProgress> progress{};  ///< it names adjusted subproblems and their inspections,
                                         ///< which are left beside it
    Parts<SubproblemTask> requests{};    ///< none: all worlds are adjusted

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("progress", &Outputs::progress);
      visit("orders", &Outputs::requests);
    }
  };

  static absl::Status Run(StageTask<SteerAdjustmentStage>& task);
};

}  // namespace orbweave
