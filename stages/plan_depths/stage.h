// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/dense_records.h"
#include "core/scene/image_manifest.h"
#include "stages/stage.h"

namespace orbweave {

/// Sources of all panoramas -> which depths are computed from what, and who has none, and why
/// (PlanDepths).
struct PlanDepthsStage {
  static constexpr StageFacts kFacts{.name = "plan_depths", .version = "1", .weight = 0.2};
  using Options = OptionSections<SourceOptions>;

  One<ImageManifest> manifest;
  One<FinalisedModel> model;
  EachPart<ChosenSources> chosen;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &PlanDepthsStage::manifest);
    visit("model", &PlanDepthsStage::model);
    visit("chosen", &PlanDepthsStage::chosen);
  }

  struct Outputs {
    using Stage = PlanDepthsStage;
    Parts<DepthRecipe> depths{};  ///< in the order of DensePlan::panoramas
    One<DensePlan> plan{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("depths", &Outputs::depths);
      visit("plan", &Outputs::plan);
    }
  };

  static absl::Status Run(StageTask<PlanDepthsStage>& task);
};

}  // namespace orbweave
