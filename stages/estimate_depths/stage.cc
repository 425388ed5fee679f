// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/estimate_depths/stage.h"

#include <nlohmann/json.hpp>

#include "core/dense/estimate_depths.h"
#include "stages/coverage.h"
#include "stages/dense_codecs.h"
#include "stages/fetch_raster.h"

namespace orbweave {
namespace {

/// Sources that cannot be read take no part; a reference that cannot leaves an empty map.
absl::StatusOr<DepthMap> Estimate(const DepthRecipe& recipe, StageTask<EstimateDepthsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(
      const FetchedGrey reference,
      FetchGrey(recipe.reference, recipe.mask_ignores_white, recipe.width_px, task.blobs()));
  if (!reference.problem.empty()) return DepthMap{.problem = reference.problem};
  std::vector<FetchedGrey> sources;
  for (const DepthSourceFile& source : recipe.sources) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(
        sources.emplace_back(),
        FetchGrey(source.panorama, recipe.mask_ignores_white, recipe.width_px, task.blobs()));
  }
  DepthProblem problem{.reference = ViewOf(reference),
                       .seeds = recipe.seeds,
                       .min_range_m = recipe.min_range,
                       .max_range_m = recipe.max_range,
                       .seed = task.DigestOf(&EstimateDepthsStage::depth).ToSeed()};
  for (size_t i = 0; i < sources.size(); ++i) {
    if (!sources[i].problem.empty()) continue;
    problem.sources.push_back({ViewOf(sources[i]), recipe.sources[i].source_from_reference});
  }
  return EstimateDepths(problem, task.options<DenseOptions>());
}

}  // namespace

absl::Status EstimateDepthsStage::Run(StageTask<EstimateDepthsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DepthRecipe recipe, task.Read(&EstimateDepthsStage::depth));
  ORBWEAVE_ASSIGN_OR_RETURN(const DepthMap map, Estimate(recipe, task));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::map, map).status());
  task.Report(nlohmann::json{{"coverage", CoverageOf(map)}, {"problem", map.problem}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
