// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/mapping/scene_correspondences.h"

namespace orbweave {

/// A pose where few scene points are seen: a verified pair with a registered image gives the
/// rotation and the direction of the baseline, so that one correspondence is enough for its length
/// s. With C = C_n + s d and the ray v of a point P in the world, (C - P) x v = 0 gives s = ((P -
/// C_n) x v) . (d x v) / |d x v|^2. Every correspondence of every such pair (the strongest five) is
/// tried, a pure rotation with s = 0; the best pose is refined on its inliers. nullopt: no pair
/// with a registered image, or no agreement.
[[nodiscard]] std::optional<Rigid3> EstimatePoseFromPairs(
    const MappingState& state,
    ImageSlot image,
    const SceneCorrespondences& correspondences,
    double max_error_rad);

}  // namespace orbweave
