// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/conclude_adjustment/stage.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "core/artifacts/check_adjustment.h"
#include "core/artifacts/check_bounds.h"
#include "core/merging/attach_loose_images.h"
#include "core/merging/checks/inspect_subproblem.h"
#include "core/merging/finalise_adjustment.h"
#include "stages/codecs.h"

namespace orbweave {

absl::Status ConcludeAdjustmentStage::Run(StageTask<ConcludeAdjustmentStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const ImageManifest manifest,
                            task.Read(&ConcludeAdjustmentStage::manifest));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JoinedWorld> worlds,
                            task.Read(&ConcludeAdjustmentStage::worlds));
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustmentProgress progress,
                            task.Read(&ConcludeAdjustmentStage::progress));
  ORBWEAVE_ASSIGN_OR_RETURN(const DividedViewGraph divided,
                            task.Read(&ConcludeAdjustmentStage::divided));
  ORBWEAVE_RETURN_IF_ERROR(CheckFinished(progress, worlds));
  ORBWEAVE_RETURN_IF_ERROR(CheckPartition(divided.partition, manifest));
  const GlobalAdjustOptions& options = task.options<GlobalAdjustOptions>();
  FinalisedModel model;
  std::vector<DriveErrors> drive_errors;  // of the first world that is georeferenced
  for (uint32_t world = 0; world < worlds.size(); ++world) {
    AdjustedWorld adjusted{.report = std::move(progress.worlds[world].report)};
    std::vector<Digest>& subproblems = model.subproblems.emplace_back();
    for (SubproblemPlace& place : progress.subproblems) {
      if (place.world != world) continue;
      ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
      subproblems.push_back(place.subproblem);
      adjusted.summaries.push_back(std::move(place.summary));
      ORBWEAVE_ASSIGN_OR_RETURN(adjusted.inspections.emplace_back(),
                                task.Fetch<SubproblemInspection>(place.inspection));
    }
    ORBWEAVE_RETURN_IF_ERROR(CheckAdjustedWorld(adjusted, worlds[world].georeference, manifest));
    adjusted.support_without =
        [&](size_t place,
            const std::set<ImageId>& without) -> absl::StatusOr<std::vector<PatchSupport>> {
      ORBWEAVE_RETURN_IF_ERROR(task.context().CheckStop());
      ORBWEAVE_ASSIGN_OR_RETURN(const Subproblem subproblem,
                                task.Fetch<Subproblem>(subproblems[place]));
      return SupportOf(subproblem, without);
    };
    ORBWEAVE_ASSIGN_OR_RETURN(FinalisedWorld finalised,
                              FinaliseAdjustment(std::move(adjusted),
                                                 divided.partition.seams,
                                                 worlds[world].georeference,
                                                 manifest,
                                                 options));
    if (finalised.images.empty()) {  // nothing in it is placed by its own observations
      std::ranges::move(finalised.report.weak_images, std::back_inserter(model.left_out));
      model.subproblems.pop_back();
      continue;
    }
    const auto is_georeferenced = [](const FinalisedWorld& of) { return of.report.gnss.used; };
    if (finalised.report.gnss.used && std::ranges::none_of(model.worlds, is_georeferenced))
      drive_errors = worlds[world].georeference.drive_errors;
    model.worlds.push_back(std::move(finalised));
  }
  if (options.attach_loose) AttachLooseImages(manifest, drive_errors, model.worlds);
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::model, model).status());
  task.Report(nlohmann::json{{"worlds", model.worlds.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
