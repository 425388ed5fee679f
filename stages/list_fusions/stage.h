// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"
#include "stages/stage.h"

namespace orbweave {

/// Which checked maps there are -> for each, what it is fused with.
struct ListFusionsStage {
  static constexpr StageFacts kFacts{.name = "list_fusions", .version = "1", .weight = 0.1};
  using Options = OptionSections<>;

  One<DensePlan> plan;
  EachPart<DepthMap> maps;  ///< only named

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("plan", &ListFusionsStage::plan);
    visit("maps", &ListFusionsStage::maps);
  }

  struct Outputs {
    using Stage = ListFusionsStage;
    Parts<FuseRecipe> fusions{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("fusions", &Outputs::fusions);
    }
  };

  static absl::Status Run(StageTask<ListFusionsStage>& task);
};

}  // namespace orbweave
