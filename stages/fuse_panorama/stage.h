// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"
#include "stages/stage.h"

namespace orbweave {

/// A checked map and its neighbours -> the points that are its own, by tile (FusePixels).
struct FusePanoramaStage {
  static constexpr StageFacts kFacts{.name = "fuse_panorama", .version = "2", .weight = 10.0};
  using Options = OptionSections<FuseOptions>;

  Parts<FuseRecipe> fusion;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("fusion", &FusePanoramaStage::fusion);
  }

  struct Outputs {
    using Stage = FusePanoramaStage;
    EachPart<TileRuns> runs{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("runs", &Outputs::runs);
    }
  };

  static absl::Status Run(StageTask<FusePanoramaStage>& task);
};

}  // namespace orbweave
