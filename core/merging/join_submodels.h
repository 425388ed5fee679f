// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/base/stage_context.h"
#include "core/merging/alignment/align_options.h"
#include "core/merging/alignment/alignment.h"
#include "core/merging/georeference/georeference.h"
#include "core/merging/merge_submodels.h"
#include "core/partitioned_ba/global_options.h"
#include "core/partitioned_ba/subproblem.h"
#include "core/scene/image_manifest.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// What is known of a world as a whole.
struct JoinedWorld {
  Georeference georeference{};
  MergeReport merge{};
  uint32_t num_images = 0;
  uint32_t num_subproblems = 0;
};

/// Where a submodel of a subproblem's cluster lies.
struct PlacedSubmodel {
  uint32_t submodel = 0;
  Sim3 world_from_submodel{};
};

/// A subproblem as far as boundaries tell, and where its cluster's inner tracks go.
struct JoinedSubproblem {
  Subproblem subproblem{};  ///< without inner tracks
  std::vector<PlacedSubmodel> submodels{};
};

struct JoinedSubmodels {
  std::vector<JoinedWorld> worlds{};
  std::vector<JoinedSubproblem> subproblems{};  ///< sorted by (world, cluster)
};

/// Brings submodels together, from their boundaries alone (BoundaryTracksOf): MergeSubmodels, then
/// a robust georeference of each world (GeoreferenceReconstruction, unless options.gnss is off), of
/// one that GNSS shows to be bent cluster by cluster (PlaceClusters, DeformWorld), then the
/// division of each world into subproblems. A panorama is owned by the cluster it is interior to,
/// or the first that has it. A track that several owners' panoramas see goes where AssignTracks
/// puts it; panoramas seen from two subproblems are separators. Worlds are in east-north-up metres
/// where georeferenced. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<JoinedSubmodels> JoinSubmodels(std::vector<Submodel> boundaries,
                                                            const Alignment& alignment,
                                                            const Partition& partition,
                                                            const ImageManifest& manifest,
                                                            const AlignOptions& align,
                                                            const GlobalAdjustOptions& options,
                                                            const StageContext& context);

/// The whole subproblem: `inner[i]` are submodels[i]'s images and inner tracks (InteriorTracksOf),
/// in its frame. Points go along with the images that see them (CarryPoint), wherever the merge put
/// those.
[[nodiscard]] Subproblem AssembleSubproblem(JoinedSubproblem joined,
                                            std::vector<Reconstruction> inner);

}  // namespace orbweave
