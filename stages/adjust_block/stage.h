// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/adjustment_records.h"
#include "stages/adjust_block/subproblem_cache.h"
#include "stages/stage.h"

namespace orbweave {

/// One subproblem and a request -> its answer; see SteerAdjustmentStage. The subproblems that a
/// process works on stay in it (SubproblemCache).
struct AdjustBlockStage {
  static constexpr StageFacts kFacts{.name = "adjust_block", .version = "6", .weight = 9.0};
  using Options = OptionSections<GlobalAdjustOptions, BundleOptions>;

  Parts<SubproblemTask> request;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("order", &AdjustBlockStage::request);
  }

  struct Outputs {
    using Stage = AdjustBlockStage;
    EachPart<SubproblemResult>
        reply{};  ///< it names the subproblem, state and inspection that are left beside it

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("answer", &Outputs::reply);
    }
  };

  static absl::Status Run(StageTask<AdjustBlockStage>& task);
  /// The same with these subproblems instead of those of the process.
  static absl::Status RunWith(SubproblemCache& cache, StageTask<AdjustBlockStage>& task);
};

}  // namespace orbweave
