// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"
#include "stages/stage.h"

namespace orbweave {

/// A map and those of its sources -> the map that they agree with (CheckDepths).
struct CheckDepthsStage {
  static constexpr StageFacts kFacts{.name = "check_depths", .version = "5", .weight = 10.0};
  using Options = OptionSections<DenseOptions>;

  Parts<CheckRecipe> check;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("check", &CheckDepthsStage::check);
  }

  struct Outputs {
    using Stage = CheckDepthsStage;
    EachPart<DepthMap> map{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("map", &Outputs::map);
    }
  };

  static absl::Status Run(StageTask<CheckDepthsStage>& task);
};

}  // namespace orbweave
