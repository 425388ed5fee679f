// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"
#include "stages/stage.h"

namespace orbweave {

/// Which maps there are -> for each, the maps of its sources.
struct ListChecksStage {
  static constexpr StageFacts kFacts{.name = "list_checks", .version = "1", .weight = 0.1};
  using Options = OptionSections<>;

  One<DensePlan> plan;
  EachPart<DepthMap> maps;  ///< only named

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("plan", &ListChecksStage::plan);
    visit("maps", &ListChecksStage::maps);
  }

  struct Outputs {
    using Stage = ListChecksStage;
    Parts<CheckRecipe> checks{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("checks", &Outputs::checks);
    }
  };

  static absl::Status Run(StageTask<ListChecksStage>& task);
};

}  // namespace orbweave
