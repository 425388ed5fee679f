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

}  // namespace

std::vector<UnevenRun> FindUnevenRuns(const MappingState& state) {
  const auto& images = state.Problem().images;
  std::vector<UnevenRun> runs;
  for (const auto& [drive, slots] : ImagesOfDrives(state)) {
    std::vector<DriveStop> stops;
    for (const ImageSlot slot : slots)
      stops.push_back({images[slot].rank_in_drive, state.Centre(slot)});
    for (UnevenStop uneven : FindUnevenStops(stops)) {
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

}  // namespace orbweave
