// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/check_depths/stage.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/dense/check_depths.h"
#include "stages/coverage.h"
#include "stages/dense_codecs.h"
#include "stages/place_maps.h"

namespace orbweave {
namespace {

/// Without what is not asked of them.
absl::StatusOr<std::vector<DepthMap>> FetchSources(const CheckRecipe& recipe,
                                                   StageTask<CheckDepthsStage>& task) {
  std::vector<DepthMap> maps;
  for (const PlacedMap& source : recipe.sources) {
    ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
    ORBWEAVE_ASSIGN_OR_RETURN(maps.emplace_back(), FetchMap(source, task.blobs()));
    maps.back().views = {};
  }
  return maps;
}

absl::StatusOr<DepthMap> Check(const CheckRecipe& recipe, StageTask<CheckDepthsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(DepthMap own, FetchMap(recipe.own, task.blobs()));
  if (own.size() == 0) return own;
  const Rigid3 model_from_own = recipe.own.cam_from_model.Inverse();
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<DepthMap> maps, FetchSources(recipe, task));
  std::vector<NeighbourMap> neighbours;
  for (size_t i = 0; i < maps.size(); ++i) {
    neighbours.push_back(
        {.map = &maps[i],
         .neighbour_from_reference = recipe.sources[i].cam_from_model * model_from_own});
  }
  return CheckDepths(std::move(own), neighbours, task.options<DenseOptions>());
}

}  // namespace

absl::Status CheckDepthsStage::Run(StageTask<CheckDepthsStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const CheckRecipe recipe, task.Read(&CheckDepthsStage::check));
  ORBWEAVE_ASSIGN_OR_RETURN(const DepthMap map, Check(recipe, task));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::map, map).status());
  task.Report(nlohmann::json{{"coverage", CoverageOf(map)}, {"problem", map.problem}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
