// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/merging/alignment/alignment.h"
#include "core/merging/alignment/submodel.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

struct MergeOptions {
  /// Common tracks whose points are further apart stay two, in standard deviations of a bearing (a
  /// pixel or so), unless all seams are so wide.
  double max_error_px = 16.0;
};

struct MergeReport {
  uint32_t united_tracks = 0;       ///< tracks joined from two or more submodels
  uint32_t conflicting_tracks = 0;  ///< joins refused: two features of one image, or points apart
};

struct MergedWorld {
  Reconstruction reconstruction{};
  MergeReport report{};
};

/// One reconstruction per world of the alignment that has images, in world order: poses of shared
/// images averaged robustly (FusePoses), tracks united by (image, feature) with conflict checks
/// (UniteTracks). A good start for bundle adjustment, which removes what the seams leave.
[[nodiscard]] std::vector<MergedWorld> MergeSubmodels(std::vector<Submodel> submodels,
                                                      const Alignment& alignment,
                                                      const MergeOptions& options = {});

}  // namespace orbweave
