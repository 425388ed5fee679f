// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "stages/stage.h"

namespace orbweave {

/// Points of a tile, or of a piece of one, by panorama -> the tile.
struct AssembleTileStage {
  static constexpr StageFacts kFacts{.name = "assemble_tile", .version = "2", .weight = 2.0};
  using Options = OptionSections<>;

  Parts<TileRecipe> recipe;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("recipe", &AssembleTileStage::recipe);
  }

  struct Outputs {
    using Stage = AssembleTileStage;
    EachPart<DenseTile> tile{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("tile", &Outputs::tile);
    }
  };

  static absl::Status Run(StageTask<AssembleTileStage>& task);
};

}  // namespace orbweave
