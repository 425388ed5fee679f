// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/fuse_panorama/stage.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "stages/codecs.h"
#include "stages/dense_codecs.h"
#include "stages/fetch_raster.h"
#include "stages/place_maps.h"

namespace orbweave {
namespace {

absl::StatusOr<FusedPanorama> Fuse(const FuseRecipe& recipe, StageTask<FusePanoramaStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const DepthMap own, FetchMap(recipe.own, task.blobs()));
  if (own.size() == 0) return FusedPanorama{.problem = own.problem};
  ORBWEAVE_ASSIGN_OR_RETURN(
      const FetchedRaster image,
      FetchRaster(recipe.file, recipe.mask_ignores_white, 4 * own.face_px, task.blobs()));
  if (!image.problem.empty()) return FusedPanorama{.problem = image.problem};
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<DepthMap> maps,
                            FetchMaps(recipe.neighbours, task.blobs(), task.context()));
  std::vector<PosedDepthMap> neighbours;
  for (size_t i = 0; i < maps.size(); ++i) {
    const PlacedMap& placed = recipe.neighbours[i];
    neighbours.push_back({placed.image, &maps[i], placed.cam_from_model});
  }
  return FusePixels({recipe.own.image, &own, recipe.own.cam_from_model},
                    ViewOf(image.raster),
                    neighbours,
                    task.options<FuseOptions>());
}

absl::StatusOr<TileRuns> LeaveByTile(SurfacePoints points, StageTask<FusePanoramaStage>& task) {
  TileRuns runs;
  for (const TileRun& run : GroupByTile({}, points)) {
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(run.begin);
    const SurfacePoints in_cell(first, first + static_cast<std::ptrdiff_t>(run.count));
    ORBWEAVE_ASSIGN_OR_RETURN(const Digest digest, task.LeaveBulk(in_cell));
    runs.runs.push_back({.cell = run.cell, .count = run.count, .points = digest});
  }
  return runs;
}

}  // namespace

absl::Status FusePanoramaStage::Run(StageTask<FusePanoramaStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const FuseRecipe recipe, task.Read(&FusePanoramaStage::fusion));
  ORBWEAVE_ASSIGN_OR_RETURN(FusedPanorama fused, Fuse(recipe, task));
  const size_t count = fused.points.size();
  ORBWEAVE_ASSIGN_OR_RETURN(const TileRuns runs, LeaveByTile(std::move(fused.points), task));
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::runs, runs).status());
  task.Report(nlohmann::json{
      {"points", count}, {"checked_pixels", fused.checked_pixels}, {"problem", fused.problem}}
                  .dump());
  return absl::OkStatus();
}

}  // namespace orbweave
