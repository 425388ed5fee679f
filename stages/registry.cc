// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "stages/registry.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "stages/adjust_block/stage.h"
#include "stages/align_submodels/stage.h"
#include "stages/assemble_block/stage.h"
#include "stages/assemble_tile/stage.h"
#include "stages/check_depths/stage.h"
#include "stages/codecs.h"
#include "stages/conclude_adjustment/stage.h"
#include "stages/dense_codecs.h"
#include "stages/estimate_depths/stage.h"
#include "stages/extract_features/stage.h"
#include "stages/fit_seams/stage.h"
#include "stages/fuse_panorama/stage.h"
#include "stages/ingest_images/stage.h"
#include "stages/join_submodels/stage.h"
#include "stages/list_checks/stage.h"
#include "stages/list_extractions/stage.h"
#include "stages/list_fusions/stage.h"
#include "stages/list_pairs/stage.h"
#include "stages/list_seams/stage.h"
#include "stages/list_tiles/stage.h"
#include "stages/list_views/stage.h"
#include "stages/match_images/stage.h"
#include "stages/partition_view_graph/stage.h"
#include "stages/plan_depths/stage.h"
#include "stages/reconstruct_cluster/stage.h"
#include "stages/review_seams/stage.h"
#include "stages/select_image_pairs/stage.h"
#include "stages/select_views/stage.h"
#include "stages/select_wider_pairs/stage.h"
#include "stages/steer_adjustment/stage.h"
#include "stages/verify_matches/stage.h"

namespace orbweave {

const std::vector<Stage>& AllStages() {
  static const auto* const kStages = new std::vector<Stage>{
      Describe<IngestImagesStage>(),       Describe<ListExtractionsStage>(),
      Describe<ExtractFeaturesStage>(),    Describe<SelectImagePairsStage>(),
      Describe<ListPairsStage>(),          Describe<MatchImagesStage>(),
      Describe<SelectWiderPairsStage>(),   Describe<VerifyMatchesStage>(),
      Describe<PartitionViewGraphStage>(), Describe<ReconstructClusterStage>(),
      Describe<ListSeamsStage>(),          Describe<FitSeamsStage>(),
      Describe<AlignSubmodelsStage>(),     Describe<ReviewSeamsStage>(),
      Describe<JoinSubmodelsStage>(),      Describe<AssembleBlockStage>(),
      Describe<SteerAdjustmentStage>(),    Describe<AdjustBlockStage>(),
      Describe<ConcludeAdjustmentStage>(), Describe<ListViewsStage>(),
      Describe<SelectViewsStage>(),        Describe<PlanDepthsStage>(),
      Describe<EstimateDepthsStage>(),     Describe<ListChecksStage>(),
      Describe<CheckDepthsStage>(),        Describe<ListFusionsStage>(),
      Describe<FusePanoramaStage>(),       Describe<ListTilesStage>(),
      Describe<AssembleTileStage>(),
  };
  return *kStages;
}

absl::StatusOr<const Stage*> FindStage(std::string_view name) {
  const auto name_of = [](const Stage& stage) { return stage.facts.name; };
  const auto found = std::ranges::find(AllStages(), name, name_of);
  if (found != AllStages().end()) return &*found;
  return absl::NotFoundError(absl::StrCat("this build has no stage ", std::string(name)));
}

const StageFunction* FindStageFunction(std::string_view name) {
  const absl::StatusOr<const Stage*> stage = FindStage(name);
  return stage.ok() ? &(*stage)->run : nullptr;
}

}  // namespace orbweave
