// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/features/sift_tiles.h"
#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

/// At most `max_features` candidates, the most likely to be found again first, spread over the
/// sphere. Merit is contrast x scale; in each of 24 x 12 equal-area cells (equal steps of longitude
/// and of the sine of latitude) it is divided by sqrt(1 + n / fair share), n better ones being in
/// the cell already. A strict equal share per cell would fill blank walls and sky with noise. Ties
/// are broken by position, so the choice does not depend on the candidates' order. Sorted by row,
/// then column.
[[nodiscard]] std::vector<SiftCandidate> SelectSpread(const EquirectangularCamera& camera,
                                                      const std::vector<SiftCandidate>& candidates,
                                                      size_t max_features);

}  // namespace orbweave
