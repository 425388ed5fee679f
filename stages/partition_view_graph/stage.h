// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/artifacts/recipes.h"
#include "core/artifacts/stage_results.h"
#include "core/io/images/cluster_table.h"
#include "core/merging/alignment/review_seams.h"
#include "core/scene/features.h"
#include "core/scene/image_manifest.h"
#include "core/scene/two_view_geometry.h"
#include "stages/stage.h"

namespace orbweave {

/// All verified pairs -> the view graph without those that contradict (ChooseEdges), and its
/// clusters: in the first round by hand or by METIS (PartitionViewGraph), later those of the round
/// before with more overlap where that was asked for (WidenOverlaps).
struct PartitionViewGraphStage {
  static constexpr StageFacts kFacts{
      .name = "partition_view_graph", .version = "29", .weight = 1.0};
  using Options = OptionSections<ViewGraphOptions, PartitionOptions>;

  One<ImageManifest> manifest;
  Interleaved<Features, PlaceSample> features;  ///< only named
  EachPart<std::vector<TwoViewGeometry>> verified;
  One<ClusterNames> clusters_by_hand;  ///< empty: none
  RoundBefore<One<DividedViewGraph>> before;
  RoundBefore<One<PartitionReview>> review;

  template <typename Visitor>
  static void VisitPorts(Visitor&& visit) {
    visit("manifest", &PartitionViewGraphStage::manifest);
    visit("features", &PartitionViewGraphStage::features);
    visit("verified", &PartitionViewGraphStage::verified);
    visit("clusters_by_hand", &PartitionViewGraphStage::clusters_by_hand);
    visit("before", &PartitionViewGraphStage::before);
    visit("review", &PartitionViewGraphStage::review);
  }

  struct Outputs {
    using Stage = PartitionViewGraphStage;
    One<DividedViewGraph> divided{};
    Parts<ClusterRecipe> clusters{};

    template <typename Visitor>
    static void VisitPorts(Visitor&& visit) {
      visit("divided", &Outputs::divided);
      visit("clusters", &Outputs::clusters);
    }
  };

  static absl::Status Run(StageTask<PartitionViewGraphStage>& task);
};

}  // namespace orbweave
