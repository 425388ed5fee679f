// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "stages/stage.h"

namespace orbweave {

/// A subproblem -> what each of its panoramas is to be compared with (SelectSources).
struct SelectViewsStage {
  static constexpr StageFacts kFacts{.name = "select_views", .version = "1", .weight = 1.0};
  using Options = OptionSections<SourceOptions>;

  Parts<ViewRecipe> view;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("view", &SelectViewsStage::view);
  }

  struct Outputs {
    using Stage = SelectViewsStage;
    EachPart<ChosenSources> chosen{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("chosen", &Outputs::chosen);
    }
  };

  static absl::Status Run(StageTask<SelectViewsStage>& task);
};

}  // namespace orbweave
