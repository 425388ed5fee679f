// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/reconstruction.h"

namespace orbweave {

/// What a submodel has to do with others: all its poses, and the tracks that one of the `shared`
/// images (sorted; those that other submodels may hold too) sees. Tracks of two submodels have a
/// feature in common only if both are in their boundaries, so that boundaries are enough to align
/// submodels and to unite their tracks.
[[nodiscard]] Reconstruction BoundaryTracksOf(const Reconstruction& submodel,
                                              const std::vector<ImageId>& shared);

/// All poses, and the other tracks.
[[nodiscard]] Reconstruction InteriorTracksOf(const Reconstruction& submodel,
                                              const std::vector<ImageId>& shared);

}  // namespace orbweave
