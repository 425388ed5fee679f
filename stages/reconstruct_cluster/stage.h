// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/artifacts/recipes.h"
#include "core/artifacts/stage_results.h"
#include "stages/stage.h"

namespace orbweave {

/// The images of a cluster and their pairs -> its submodels (ReconstructCluster).
struct ReconstructClusterStage {
  static constexpr StageFacts kFacts{
      .name = "reconstruct_cluster", .version = "91", .weight = 28.0};
  using Options = OptionSections<MappingOptions>;

  Parts<ClusterRecipe> cluster;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("cluster", &ReconstructClusterStage::cluster);
  }

  struct Outputs {
    using Stage = ReconstructClusterStage;
    EachPart<ClusterResult> whole{};
    EachPart<ClusterResult>
        boundary{};  ///< the same without what lies inside the cluster (BoundaryTracksOf)

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("whole", &Outputs::whole);
      visit("rim", &Outputs::boundary);
    }
  };

  static absl::Status Run(StageTask<ReconstructClusterStage>& task);
};

}  // namespace orbweave
