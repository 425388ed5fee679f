// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/dense_records.h"
#include "stages/stage.h"

namespace orbweave {

/// A finished model -> its subproblems, for whose panoramas sources are chosen.
struct ListViewsStage {
  static constexpr StageFacts kFacts{.name = "list_views", .version = "1", .weight = 0.1};
  using Options = OptionSections<>;

  One<FinalisedModel> model;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("model", &ListViewsStage::model);
  }

  struct Outputs {
    using Stage = ListViewsStage;
    Parts<ViewRecipe> views{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("views", &Outputs::views);
    }
  };

  static absl::Status Run(StageTask<ListViewsStage>& task);
};

}  // namespace orbweave
