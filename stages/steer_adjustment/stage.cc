// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/steer_adjustment/stage.h"

#include <nlohmann/json.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/artifacts/check_bounds.h"
#include "core/merging/checks/inspect_subproblem.h"
#include "core/partitioned_ba/adjust_subproblems.h"
#include "stages/codecs.h"
#include "stages/steer_adjustment/advance_adjustment.h"

namespace orbweave {
namespace {

using Task = StageTask<SteerAdjustmentStage>;

absl::StatusOr<SubproblemPlace> AdjustedPlace(uint32_t world,
                                              const Subproblem& subproblem,
                                              SubproblemSummary summary,
                                              Task& task) {
  SubproblemPlace place{.world = world, .summary = std::move(summary)};
  ORBWEAVE_ASSIGN_OR_RETURN(place.subproblem, task.LeaveBulk(subproblem));
  ORBWEAVE_ASSIGN_OR_RETURN(
      place.inspection, task.LeaveBulk(InspectSubproblem(subproblem, task.context().num_threads)));
  return place;
}

/// Adjusts the whole world that these subproblems are, and adds where they are then to `places`.
absl::StatusOr<GlobalAdjustReport> AdjustHere(uint32_t world,
                                              std::span<const Digest> subproblems,
                                              std::vector<SubproblemPlace>& places,
                                              Task& task) {
  std::vector<Subproblem> own;
  for (const Digest& subproblem : subproblems) {
    ORBWEAVE_ASSIGN_OR_RETURN(own.emplace_back(), task.Fetch<Subproblem>(subproblem));
    if (own.back().world != world)
      return BlameBlob(DoesNotFit("a block is of another world"), subproblem);
  }
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustedSubproblems adjusted,
                            AdjustSubproblems(std::move(own),
                                              task.options<GlobalAdjustOptions>(),
                                              task.options<BundleOptions>(),
                                              task.context()));
  for (size_t b = 0; b < adjusted.subproblems.size(); ++b) {
    ORBWEAVE_ASSIGN_OR_RETURN(
        places.emplace_back(),
        AdjustedPlace(world, adjusted.subproblems[b], std::move(adjusted.summaries[b]), task));
  }
  return std::move(adjusted.report);
}

bool IsDistributed(const JoinedWorld& world, const DistributionOptions& options) {
  return world.num_images >= static_cast<uint32_t>(options.distribute_from);
}

absl::StatusOr<AdvancedAdjustment> FirstRound(Task& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<JoinedWorld> worlds,
                            task.Read(&SteerAdjustmentStage::worlds));
  ORBWEAVE_ASSIGN_OR_RETURN(const std::vector<Digest> subproblems,
                            task.Read(&SteerAdjustmentStage::subproblems));
  std::vector<SubproblemPlace> places;
  std::vector<GlobalAdjustReport> reports(worlds.size());
  std::vector<uint8_t> is_distributed;
  std::span<const Digest> rest(subproblems);
  for (uint32_t world = 0; world < worlds.size(); ++world) {
    if (worlds[world].num_subproblems > rest.size())
      return absl::InvalidArgumentError("steer_adjustment: the blocks are of other worlds");
    const std::span<const Digest> own = rest.first(worlds[world].num_subproblems);
    rest = rest.subspan(own.size());
    is_distributed.push_back(IsDistributed(worlds[world], task.options<DistributionOptions>()) ? 1
                                                                                               : 0);
    if (is_distributed.back() != 0) {
      for (const Digest& subproblem : own)
        places.push_back({.world = world, .subproblem = subproblem});
    } else {
      ORBWEAVE_ASSIGN_OR_RETURN(reports[world], AdjustHere(world, own, places, task));
    }
  }
  if (!rest.empty())
    return absl::InvalidArgumentError("steer_adjustment: the blocks are of other worlds");
  AdvancedAdjustment advanced = StartAdjustment(std::move(places),
                                                is_distributed,
                                                task.options<GlobalAdjustOptions>(),
                                                task.options<BundleOptions>());
  for (uint32_t world = 0; world < worlds.size(); ++world) {
    if (is_distributed[world] == 0)
      advanced.progress.worlds[world].report = std::move(reports[world]);
  }
  return advanced;
}

}  // namespace

absl::Status SteerAdjustmentStage::Run(StageTask<SteerAdjustmentStage>& task) {
  ORBWEAVE_ASSIGN_OR_RETURN(AdjustmentProgress progress, task.Read(&SteerAdjustmentStage::before));
  AdvancedAdjustment advanced;
  if (progress.worlds.empty()) {
    ORBWEAVE_ASSIGN_OR_RETURN(advanced, FirstRound(task));
  } else {
    ORBWEAVE_ASSIGN_OR_RETURN(std::vector<SubproblemResult> replies,
                              task.ReadAll(&SteerAdjustmentStage::replies));
    ORBWEAVE_ASSIGN_OR_RETURN(advanced,
                              AdvanceAdjustment(std::move(progress),
                                                std::move(replies),
                                                task.options<GlobalAdjustOptions>(),
                                                task.options<BundleOptions>()));
  }
  ORBWEAVE_RETURN_IF_ERROR(task.Leave(&Outputs::progress, advanced.progress).status());
  ORBWEAVE_RETURN_IF_ERROR(task.LeaveAll(&Outputs::requests, advanced.tasks));
  task.Report(nlohmann::json{{"blocks_asked", advanced.tasks.size()}}.dump());
  return absl::OkStatus();
}

}  // namespace orbweave
