// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "core/features/sift/row_ring.h"
#include "core/features/sift/sift_kernels.h"
#include "core/features/sift/sift_position.h"
#include "core/features/sift_thresholds.h"

namespace orbweave::internal {

/// Quadratic fit of the difference of Gaussians in (x, y, scale) about an extremum, moved to the
/// next pixel or level while its top lies there. None where the top is not found within five pixels
/// (kRefinementReach), its contrast is too weak, or it is an edge. The row may be beyond a pole,
/// the column beyond the seam by as much. Lowe, IJCV 2004, section 4.
[[nodiscard]] std::optional<SiftPosition> RefineExtremum(
    const std::array<const RowRing*, kSiftLevels>& levels,
    const SiftHit& hit,
    const SiftThresholds& thresholds);

}  // namespace orbweave::internal
