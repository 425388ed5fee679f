// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/merging/join_submodels.h"

#include <utility>

#include "core/merging/divide_world.h"

namespace orbweave {
namespace {

/// The cluster that answers for each image of a world: the one whose interior it is in, where that
/// has it, else the first that has it.
std::map<ImageId, uint32_t> OwnersIn(uint32_t world,
                                     const std::vector<Submodel>& rims,
                                     const Alignment& alignment,
                                     const Partition& partition) {
  std::map<ImageId, uint32_t> owners;
  for (size_t m = 0; m < rims.size(); ++m) {
    if (alignment.world[m] != world) continue;
    const std::vector<ImageId>& interior = partition.clusters[rims[m].cluster].interior;
    for (const auto& [id, image] : rims[m].reconstruction.images) {
      const auto [owner, is_new] = owners.emplace(id, rims[m].cluster);
      if (std::ranges::binary_search(interior, id)) owner->second = rims[m].cluster;
    }
  }
  return owners;
}

std::vector<PlacedComponent> ComponentsOf(const WorldBlock& block,
                                          const std::vector<Submodel>& rims,
                                          const Alignment& alignment,
                                          const JoinedWorld& world) {
  const Sim3 enu_from_world = world.georeference.enu_from_world.value_or(Sim3{});
  std::vector<PlacedComponent> components;
  for (size_t m = 0; m < rims.size(); ++m) {
    if (alignment.world[m] != block.world || rims[m].cluster != block.cluster) continue;
    components.push_back(
        {.component = rims[m].component,
         .world_from_component = enu_from_world * alignment.world_from_submodel[m]});
  }
  return components;
}

}  // namespace

absl::StatusOr<JoinedSubmodels> JoinSubmodels(const std::vector<Submodel>& rims,
                                              const Alignment& alignment,
                                              const Partition& partition,
                                              const ImageManifest& manifest,
                                              const GlobalAdjustOptions& options,
                                              const StageContext& context) {
  JoinedSubmodels joined;
  for (MergedWorld& merged : MergeSubmodels(rims, alignment)) {
    const auto number = static_cast<uint32_t>(joined.worlds.size());
    JoinedWorld world{.merge = merged.report,
                      .num_images = static_cast<uint32_t>(merged.reconstruction.images.size())};
    Reconstruction scene = std::move(merged.reconstruction);
    ORBWEAVE_ASSIGN_OR_RETURN(world.georeference,
                              GeoreferenceReconstruction(scene, manifest, options.gnss, context));
    if (world.georeference.enu_from_world) {
      scene = Transformed(*world.georeference.enu_from_world, std::move(scene));
    }
    const auto owners = OwnersIn(number, rims, alignment, partition);
    for (WorldBlock& block : DivideWorld(std::move(scene),
                                         number,
                                         owners,
                                         world.georeference,
                                         manifest,
                                         options.gnss_bias_sigma_m)) {
      std::vector<PlacedComponent> components = ComponentsOf(block, rims, alignment, world);
      joined.blocks.push_back({std::move(block), std::move(components)});
      ++world.num_blocks;
    }
    joined.worlds.push_back(std::move(world));
  }
  return joined;
}

WorldBlock AssembleBlock(JoinedBlock joined, std::vector<std::vector<Track>> inner) {
  ORBWEAVE_CHECK(inner.size() == joined.components.size());
  WorldBlock block = std::move(joined.block);
  for (size_t i = 0; i < inner.size(); ++i) {
    for (Track& track : inner[i]) {
      track.point_in_world = joined.components[i].world_from_component * track.point_in_world;
      block.scene.tracks.push_back(std::move(track));
    }
  }
  DropLooseObservations(block.scene);
  block.scene.SortTracks();
  return block;
}

}  // namespace orbweave
