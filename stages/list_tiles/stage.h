// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/tile_options.h"
#include "stages/stage.h"

namespace orbweave {

/// What each panorama has in which tile -> the tiles. A tile of more than max_points is cut
/// into pieces, each of whole panoramas, so that what assembles one needs memory for so many, or
/// for those of one panorama.
struct ListTilesStage {
  static constexpr StageFacts kFacts{.name = "list_tiles", .version = "2", .weight = 0.1};
  using Options = OptionSections<TileOptions>;

  EachPart<TileRuns> runs;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("runs", &ListTilesStage::runs);
  }

  struct Outputs {
    using Stage = ListTilesStage;
    Parts<TileRecipe> tiles{};  ///< ascending by cell and piece

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("tiles", &Outputs::tiles);
    }
  };

  static absl::Status Run(StageTask<ListTilesStage>& task);
};

}  // namespace orbweave
