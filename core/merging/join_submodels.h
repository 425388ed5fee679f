// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/merging/align_submodels.h"
#include "core/merging/georeference_reconstruction.h"
#include "core/merging/global_options.h"
#include "core/merging/merge_submodels.h"
#include "core/merging/world_block.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What is known of a world as a whole.
struct JoinedWorld {
  Georeference georeference{};
  MergeReport merge{};
  uint32_t num_images = 0;
  uint32_t num_blocks = 0;
};

/// Where a component of a block's cluster lies.
struct PlacedComponent {
  uint32_t component = 0;
  Sim3 world_from_component{};
};

/// A block as far as rims tell, and where its cluster's inner tracks go.
struct JoinedBlock {
  WorldBlock block{};  ///< without inner tracks
  std::vector<PlacedComponent> components{};
};

struct JoinedSubmodels {
  std::vector<JoinedWorld> worlds{};
  std::vector<JoinedBlock> blocks{};  ///< sorted by (world, cluster)
};

/// Brings submodels together, from their rims alone (RimOf): MergeSubmodels, then a robust
/// georeference of each world (GeoreferenceReconstruction, unless options.gnss is off), of one that
/// GNSS shows to be bent cluster by cluster (PlaceClusters, BendWorld), then the division of each
/// world into blocks. A panorama is owned by the cluster it is interior to, or the
/// first that has it. A track that several owners' panoramas see goes where AssignTracks puts it;
/// panoramas seen from two blocks are separators. Worlds are in east-north-up metres where
/// georeferenced. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<JoinedSubmodels> JoinSubmodels(std::vector<Submodel> rims,
                                                            const Alignment& alignment,
                                                            const Partition& partition,
                                                            const ImageManifest& manifest,
                                                            const AlignOptions& align,
                                                            const GlobalAdjustOptions& options,
                                                            const StageContext& context);

/// The whole block: `inner[i]` are components[i]'s images and inner tracks (InnerOf), in its frame.
/// Points go along with the images that see them (CarryPoint), wherever the merge put those.
[[nodiscard]] WorldBlock AssembleBlock(JoinedBlock joined, std::vector<Reconstruction> inner);

}  // namespace orbweave
