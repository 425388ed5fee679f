// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/merge_submodels.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/merging/fuse_poses.h"
#include "core/merging/unite_tracks.h"

namespace orbweave {
namespace {

std::map<ImageId, double> CountObservations(const Reconstruction& reconstruction) {
  std::map<ImageId, double> counts;
  for (const Track& track : reconstruction.tracks) {
    for (const Observation& observation : track.observations) counts[observation.ref.image] += 1.0;
  }
  return counts;
}

void CollectEstimates(const Reconstruction& in_world, PoseEstimates& estimates) {
  std::map<ImageId, double> counts = CountObservations(in_world);
  for (const auto& [id, image] : in_world.images) {
    estimates[id].push_back({.cam_from_world = image.cam_from_world,
                             .loose = image.loose,
                             .weight = std::max(1.0, counts[id])});
  }
}

// Takes the submodels of this world out of the list.
MergedWorld MergeWorld(std::vector<Submodel>& submodels,
                       const Alignment& alignment,
                       uint32_t world,
                       const MergeOptions& options) {
  PoseEstimates estimates;
  std::vector<Track> tracks;
  size_t num_tracks = 0;
  for (size_t m = 0; m < submodels.size(); ++m) {
    if (alignment.world[m] == world) num_tracks += submodels[m].reconstruction.tracks.size();
  }
  tracks.reserve(num_tracks);
  for (size_t m = 0; m < submodels.size(); ++m) {
    if (alignment.world[m] != world) continue;
    Reconstruction in_world =
        Transformed(alignment.world_from_submodel[m], std::move(submodels[m].reconstruction));
    CollectEstimates(in_world, estimates);
    std::move(in_world.tracks.begin(), in_world.tracks.end(), std::back_inserter(tracks));
  }
  MergedWorld merged;
  merged.reconstruction.images = FusePoses(estimates);
  UnitedTracks united = UniteTracks(tracks, merged.reconstruction.images, options.max_error_px);
  merged.reconstruction.tracks = std::move(united.tracks);
  merged.report = {.united_tracks = united.num_united,
                   .conflicting_tracks = united.num_conflicting};
  return merged;
}

}  // namespace

std::vector<MergedWorld> MergeSubmodels(std::vector<Submodel> submodels,
                                        const Alignment& alignment,
                                        const MergeOptions& options) {
  std::vector<MergedWorld> worlds;
  if (submodels.empty()) return worlds;
  const uint32_t num_worlds = *std::max_element(alignment.world.begin(), alignment.world.end()) + 1;
  for (uint32_t world = 0; world < num_worlds; ++world) {
    MergedWorld merged = MergeWorld(submodels, alignment, world, options);
    if (!merged.reconstruction.images.empty()) worlds.push_back(std::move(merged));
  }
  return worlds;
}

}  // namespace orbweave
