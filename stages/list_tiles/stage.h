// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "stages/stage.h"

namespace orbweave {

/// What each panorama has in which tile -> the tiles.
struct ListTilesStage {
  static constexpr StageFacts kFacts{.name = "list_tiles", .version = "1", .weight = 0.1};
  using Options = OptionSections<>;

  EachPart<TileRuns> runs;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("runs", &ListTilesStage::runs);
  }

  struct Outputs {
    using Stage = ListTilesStage;
    Parts<TileRecipe> tiles{};  ///< ascending by cell

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("tiles", &Outputs::tiles);
    }
  };

  static absl::Status Run(StageTask<ListTilesStage>& task);
};

}  // namespace orbweave
