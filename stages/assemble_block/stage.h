// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/adjustment_records.h"
#include "core/partitioned_ba/subproblem.h"
#include "stages/stage.h"

namespace orbweave {

/// A subproblem without its inner tracks, and the cluster that has them -> the subproblem
/// (AssembleSubproblem).
struct AssembleBlockStage {
  static constexpr StageFacts kFacts{.name = "assemble_block", .version = "4", .weight = 0.5};
  using Options = OptionSections<>;

  Parts<AssembleRecipe> recipe;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("recipe", &AssembleBlockStage::recipe);
  }

  struct Outputs {
    using Stage = AssembleBlockStage;
    EachPart<Subproblem> subproblem{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("block", &Outputs::subproblem);
    }
  };

  static absl::Status Run(StageTask<AssembleBlockStage>& task);
};

}  // namespace orbweave
