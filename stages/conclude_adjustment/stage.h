// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/stage_results.h"
#include "core/scene/image_manifest.h"
#include "stages/stage.h"

namespace orbweave {

/// Where all worlds came to, and what their subproblems say of the whole -> the model but for its
/// tracks, which stay in the subproblems (FinaliseAdjustment).
struct ConcludeAdjustmentStage {
  static constexpr StageFacts kFacts{.name = "conclude_adjustment", .version = "33", .weight = 1.0};
  using Options = OptionSections<GlobalAdjustOptions>;

  One<ImageManifest> manifest;
  One<std::vector<JoinedWorld>> worlds;
  One<AdjustmentProgress> progress;
  One<DividedViewGraph> divided;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &ConcludeAdjustmentStage::manifest);
    visit("worlds", &ConcludeAdjustmentStage::worlds);
    visit("progress", &ConcludeAdjustmentStage::progress);
    visit("divided", &ConcludeAdjustmentStage::divided);
  }

  struct Outputs {
    using Stage = ConcludeAdjustmentStage;
    One<FinalisedModel> model{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("model", &Outputs::model);
    }
  };

  static absl::Status Run(StageTask<ConcludeAdjustmentStage>& task);
};

}  // namespace orbweave
