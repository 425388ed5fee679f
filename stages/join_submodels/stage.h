// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/adjustment_records.h"
#include "core/artifacts/stage_results.h"
#include "core/scene/image_manifest.h"
#include "stages/stage.h"

namespace orbweave {

/// Boundaries and their alignment -> worlds, georeferenced and divided into subproblems
/// (JoinSubmodels).
struct JoinSubmodelsStage {
  static constexpr StageFacts kFacts{.name = "join_submodels", .version = "19", .weight = 0.5};
  using Options = OptionSections<AlignOptions, GlobalAdjustOptions>;

  One<ImageManifest> manifest;
  One<DividedViewGraph> divided;
  EachPart<ClusterResult> clusters;  ///< only named
  EachPart<ClusterResult> boundaries;
  One<Alignment> alignment;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &JoinSubmodelsStage::manifest);
    visit("divided", &JoinSubmodelsStage::divided);
    visit("clusters", &JoinSubmodelsStage::clusters);
    visit("rims", &JoinSubmodelsStage::boundaries);
    visit("alignment", &JoinSubmodelsStage::alignment);
  }

  struct Outputs {
    using Stage = JoinSubmodelsStage;
    One<std::vector<JoinedWorld>> worlds{};
    Parts<AssembleRecipe> subproblems{};  ///< sorted by (world, cluster)

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("worlds", &Outputs::worlds);
      visit("blocks", &Outputs::subproblems);
    }
  };

  static absl::Status Run(StageTask<JoinSubmodelsStage>& task);
};

}  // namespace orbweave
