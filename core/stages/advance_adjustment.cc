// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#include "core/stages/advance_adjustment.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

namespace orbweave {
namespace {

/// The blocks of one world.
std::span<BlockPlace> BlocksOf(uint32_t world, std::vector<BlockPlace>& blocks) {
  return {std::ranges::lower_bound(blocks, world, {}, &BlockPlace::world),
          std::ranges::upper_bound(blocks, world, {}, &BlockPlace::world)};
}

/// Remembers where results are. A try leads to another state, everything else to the one that
/// counts.
void TakePlaces(BlockOrder::Work asked,
                std::span<BlockPlace> places,
                std::span<const BlockResult> results) {
  for (size_t b = 0; b < places.size(); ++b) {
    BlockPlace& place = places[b];
    if (!results[b].block.IsZero()) place.block = results[b].block;
    if (asked == BlockOrder::Work::kTry) {
      place.trial = results[b].state;
    } else if (!results[b].state.IsZero()) {
      place.state = results[b].state;
    }
  }
}

void AddTasks(const SteeredRound& round,
              std::span<BlockPlace> places,
              std::vector<BlockTask>& tasks) {
  for (size_t b = 0; b < round.orders.size(); ++b) {
    BlockOrder order = round.orders[b];
    if (order.takes_trial) places[b].state = places[b].trial;
    // Whoever takes the block up does not know which points were shortened.
    order.takes_trial = !order.shortened.empty();
    const bool begins = order.work == BlockOrder::Work::kBegin;
    tasks.push_back({places[b].block, begins ? Digest{} : places[b].state, std::move(order)});
  }
}

}  // namespace

AdvancedAdjustment StartAdjustment(std::vector<BlockPlace> blocks,
                                   const std::vector<uint8_t>& is_distributed,
                                   const GlobalAdjustOptions& options,
                                   const BundleOptions& bundle) {
  AdvancedAdjustment advanced{.progress = {.blocks = std::move(blocks)}};
  AdjustmentProgress& progress = advanced.progress;
  for (uint32_t world = 0; world < is_distributed.size(); ++world) {
    progress.is_asked.push_back(is_distributed[world]);
    if (is_distributed[world] == 0) {
      progress.worlds.emplace_back();
      continue;
    }
    const std::span<BlockPlace> places = BlocksOf(world, progress.blocks);
    SteeredRound round = BeginAdjustment(places.size(), options, bundle);
    AddTasks(round, places, advanced.tasks);
    progress.worlds.push_back(std::move(round.path));
  }
  return advanced;
}

absl::StatusOr<AdvancedAdjustment> AdvanceAdjustment(AdjustmentProgress progress,
                                                     std::vector<BlockResult> results,
                                                     const GlobalAdjustOptions& options,
                                                     const BundleOptions& bundle) {
  AdvancedAdjustment advanced{.progress = std::move(progress)};
  size_t first = 0;
  for (uint32_t world = 0; world < advanced.progress.worlds.size(); ++world) {
    if (advanced.progress.is_asked[world] == 0) continue;
    WorldPath& path = advanced.progress.worlds[world];
    const std::span<BlockPlace> places = BlocksOf(world, advanced.progress.blocks);
    if (results.size() - first < places.size()) {
      return absl::InvalidArgumentError("steer_adjustment: " + std::to_string(results.size()) +
                                        " results are too few");
    }
    const std::span<BlockResult> own(&results[first], places.size());
    first += places.size();
    TakePlaces(path.asked, places, own);
    std::vector<BlockAnswer> answers;
    for (BlockResult& result : own) answers.push_back(std::move(result.answer));
    SteeredRound round = SteerAdjustment(std::move(path), answers, options, bundle);
    AddTasks(round, places, advanced.tasks);
    path = std::move(round.path);
    if (!round.orders.empty()) continue;
    advanced.progress.is_asked[world] = 0;
    for (size_t b = 0; b < places.size(); ++b) {
      places[b].summary = std::move(answers[b].summary);
      places[b].inspection = own[b].inspection;
    }
  }
  if (first != results.size())
    return absl::InvalidArgumentError("steer_adjustment: results of blocks that were not asked");
  return advanced;
}

}  // namespace orbweave
