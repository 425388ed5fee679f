// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "core/features/sift_tiles.h"
#include "core/geometry/equirectangular_camera.h"

namespace orbweave {

/// At most `max_features` candidates spread over the sphere: in equal-area cells (equal steps of
/// longitude and of the sine of latitude) the strongest first, one per cell and round, until there
/// are enough. Ties are broken by position, so the choice does not depend on the candidates' order.
/// Sorted by row, then column.
[[nodiscard]] std::vector<SiftCandidate> SelectSpread(const EquirectangularCamera& camera,
                                                      std::vector<SiftCandidate> candidates,
                                                      size_t max_features);

}  // namespace orbweave
