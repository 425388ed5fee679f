// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stages/steer_adjustment/advance_adjustment.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "core/artifacts/check_adjustment.h"

namespace orbweave {
namespace {

/// The subproblems of one world.
std::span<SubproblemPlace> SubproblemsOf(uint32_t world,
                                         std::vector<SubproblemPlace>& subproblems) {
  return {std::ranges::lower_bound(subproblems, world, {}, &SubproblemPlace::world),
          std::ranges::upper_bound(subproblems, world, {}, &SubproblemPlace::world)};
}

/// Remembers where results are. A try leads to another state, everything else to the one that
/// counts.
void TakePlaces(LmRequest::Work asked,
                std::span<SubproblemPlace> places,
                std::span<const SubproblemResult> results) {
  for (size_t b = 0; b < places.size(); ++b) {
    SubproblemPlace& place = places[b];
    if (!results[b].subproblem.IsZero()) place.subproblem = results[b].subproblem;
    if (asked == LmRequest::Work::kTrial) {
      place.trial = results[b].state;
    } else if (!results[b].state.IsZero()) {
      place.state = results[b].state;
    }
  }
}

void AddTasks(const WorldRound& round,
              std::span<SubproblemPlace> places,
              std::vector<SubproblemTask>& tasks) {
  for (size_t b = 0; b < round.requests.size(); ++b) {
    LmRequest request = round.requests[b];
    if (request.takes_trial) places[b].state = places[b].trial;
    // Whoever takes the subproblem up does not know which points were shortened.
    request.takes_trial = !request.shortened.empty();
    const bool begins = request.work == LmRequest::Work::kEvaluate;
    tasks.push_back(
        {places[b].subproblem, begins ? Digest{} : places[b].state, std::move(request)});
  }
}

}  // namespace

AdvancedAdjustment StartAdjustment(std::vector<SubproblemPlace> subproblems,
                                   const std::vector<uint8_t>& is_distributed,
                                   const GlobalAdjustOptions& options,
                                   const BundleOptions& bundle) {
  AdvancedAdjustment advanced{.progress = {.subproblems = std::move(subproblems)}};
  AdjustmentProgress& progress = advanced.progress;
  for (uint32_t world = 0; world < is_distributed.size(); ++world) {
    progress.is_asked.push_back(is_distributed[world]);
    if (is_distributed[world] == 0) {
      progress.worlds.emplace_back();
      continue;
    }
    const std::span<SubproblemPlace> places = SubproblemsOf(world, progress.subproblems);
    WorldRound round = StartWorld(places.size(), options, bundle);
    AddTasks(round, places, advanced.tasks);
    progress.worlds.push_back(std::move(round.path));
  }
  return advanced;
}

absl::StatusOr<AdvancedAdjustment> AdvanceAdjustment(AdjustmentProgress progress,
                                                     std::vector<SubproblemResult> results,
                                                     const GlobalAdjustOptions& options,
                                                     const BundleOptions& bundle) {
  AdvancedAdjustment advanced{.progress = std::move(progress)};
  size_t first = 0;
  for (uint32_t world = 0; world < advanced.progress.worlds.size(); ++world) {
    if (advanced.progress.is_asked[world] == 0) continue;
    WorldProgress& path = advanced.progress.worlds[world];
    const std::span<SubproblemPlace> places = SubproblemsOf(world, advanced.progress.subproblems);
    if (results.size() - first < places.size()) {
      return absl::InvalidArgumentError("steer_adjustment: " + std::to_string(results.size()) +
                                        " results are too few");
    }
    const std::span<SubproblemResult> own = std::span(results).subspan(first, places.size());
    first += places.size();
    ORBWEAVE_RETURN_IF_ERROR(CheckReplies(path, own, options));
    TakePlaces(path.asked, places, own);
    std::vector<LmReply> replies;
    for (SubproblemResult& result : own) replies.push_back(std::move(result.reply));
    WorldRound round = AdvanceWorld(std::move(path), replies, options, bundle);
    AddTasks(round, places, advanced.tasks);
    path = std::move(round.path);
    if (!round.requests.empty()) continue;
    advanced.progress.is_asked[world] = 0;
    for (size_t b = 0; b < places.size(); ++b) {
      places[b].summary = std::move(replies[b].summary);
      places[b].inspection = own[b].inspection;
    }
  }
  if (first != results.size())
    return absl::InvalidArgumentError("steer_adjustment: results of blocks that were not asked");
  return advanced;
}

}  // namespace orbweave
