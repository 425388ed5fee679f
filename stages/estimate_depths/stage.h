// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/dense_records.h"
#include "core/dense/depth_map.h"
#include "stages/stage.h"

namespace orbweave {

/// A panorama and its sources -> its depth map (EstimateDepths).
struct EstimateDepthsStage {
  static constexpr StageFacts kFacts{.name = "estimate_depths", .version = "5", .weight = 60.0};
  using Options = OptionSections<DenseOptions>;

  Parts<DepthRecipe> depth;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("depth", &EstimateDepthsStage::depth);
  }

  struct Outputs {
    using Stage = EstimateDepthsStage;
    EachPart<DepthMap> map{};  ///< empty, with its reason, where nothing could be computed

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("map", &Outputs::map);
    }
  };

  static absl::Status Run(StageTask<EstimateDepthsStage>& task);
};

}  // namespace orbweave
