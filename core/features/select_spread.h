// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/equirectangular_camera.h"
#include "core/scene/features.h"

namespace orbweave {

/// What is known of a keypoint before it is described.
struct ScoredKeypoint {
  Keypoint keypoint{};
  float response = 0.0F;  ///< contrast, for greys in 0 ... 1
};

/// The numbers of at most `max_features` candidates, the most likely to be found again, spread over
/// the sphere. Merit is contrast x scale; in each of 24 x 12 equal-area cells (equal steps of
/// longitude and of the sine of latitude) it is divided by sqrt(1 + n / fair share), n better ones
/// being in the cell already. A strict equal share per cell would fill blank walls and sky with
/// noise. Ties are broken by position, so the choice does not depend on the candidates' order.
/// Sorted by row, then column.
[[nodiscard]] std::vector<uint32_t> SelectSpread(const EquirectangularCamera& camera,
                                                 std::span<const ScoredKeypoint> candidates,
                                                 size_t max_features);

}  // namespace orbweave
