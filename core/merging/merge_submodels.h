// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/merging/align_submodels.h"

namespace orbweave {

struct MergeReport {
  uint32_t united_tracks = 0;     ///< tracks joined from two or more submodels
  uint32_t conflicting_tracks = 0;///< joins refused: two features of one image
};

struct MergedWorld {
  Reconstruction reconstruction{};
  MergeReport report{};
};

/// One reconstruction per world of the alignment: poses of shared images averaged robustly, tracks united by union-find over
/// (image, feature) with conflict checks. Ordered by world index.
[[nodiscard]] std::vector<MergedWorld> MergeSubmodels(const std::vector<Submodel>& submodels, const Alignment& alignment);

}  // namespace orbweave
