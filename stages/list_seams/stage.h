// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/stage_results.h"
#include "core/base/digest.h"
#include "stages/stage.h"

namespace orbweave {

/// Which clusters have a seam -> for each cluster, whose boundaries to compare (PlanSeams).
struct ListSeamsStage {
  static constexpr StageFacts kFacts{.name = "list_seams", .version = "1", .weight = 0.1};
  using Options = OptionSections<>;

  One<DividedViewGraph> divided;
  EachPart<ClusterResult> boundaries;  ///< only named

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("divided", &ListSeamsStage::divided);
    visit("rims", &ListSeamsStage::boundaries);
  }

  struct Outputs {
    using Stage = ListSeamsStage;
    Parts<std::vector<Digest>> rims_to_compare{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("rims_to_compare", &Outputs::rims_to_compare);
    }
  };

  static absl::Status Run(StageTask<ListSeamsStage>& task);
};

}  // namespace orbweave
