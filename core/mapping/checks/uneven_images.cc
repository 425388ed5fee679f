// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/checks/uneven_images.h"

#include <map>
#include <span>

#include "core/mapping/model/registered_by_drive.h"

namespace orbweave {
namespace {

std::map<uint32_t, std::vector<ImageSlot>> ImagesOfDrives(const MappingState& state) {
  const auto& images = state.Problem().images;
  std::map<uint32_t, std::vector<ImageSlot>> drives;
  for (const ImageSlot slot : RegisteredByDrive(state)) drives[images[slot].drive].push_back(slot);
  return drives;
}

std::vector<DriveStop> StopsOf(const MappingState& state, std::span<const ImageSlot> slots) {
  std::vector<DriveStop> stops;
  for (const ImageSlot slot : slots)
    stops.push_back({state.Problem().images[slot].rank_in_drive, state.Centre(slot)});
  return stops;
}

}  // namespace

std::vector<UnevenRun> FindUnevenRuns(const MappingState& state) {
  const auto& images = state.Problem().images;
  std::vector<UnevenRun> runs;
  for (const auto& [drive, slots] : ImagesOfDrives(state)) {
    for (UnevenStop uneven : FindUnevenStops(StopsOf(state, slots))) {
      if (IsBorneOut(uneven,
                     images[slots[uneven.first]].prior,
                     images[slots[uneven.stop]].prior,
                     images[slots[uneven.last]].prior))
        continue;
      const auto run = std::span(slots).subspan(uneven.first, uneven.last - uneven.first + 1);
      uneven.stop -= uneven.first;
      uneven.last -= uneven.first;
      uneven.first = 0;
      runs.push_back({{run.begin(), run.end()}, uneven});
    }
  }
  return runs;
}

std::vector<VanishedWay> FindVanishedWays(const MappingState& state) {
  std::vector<VanishedWay> ways;
  for (const auto& [drive, slots] : ImagesOfDrives(state)) {
    const std::vector<DriveStop> stops = StopsOf(state, slots);
    const auto prior_of = [&, &slots = slots](size_t stop) -> const PosePrior& {
      return state.Problem().images[slots[stop]].prior;
    };
    for (const VanishedStep& vanished : FindVanishedSteps(stops)) {
      if (IsDoubted(vanished, stops, prior_of))
        ways.push_back(
            {slots[vanished.stop], slots[vanished.stop + 1], vanished.step, vanished.share});
    }
  }
  return ways;
}

}  // namespace orbweave
