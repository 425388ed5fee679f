// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/scene/image_manifest.h"

namespace orbweave {

/// Horizontal distance between the positions of two images, metres. Both have one.
[[nodiscard]] double DistanceBetween(const PosePrior& a, const PosePrior& b);

/// Standard deviation of it, metres, of two independent positions.
[[nodiscard]] double SigmaBetween(const PosePrior& a, const PosePrior& b);

/// The usual one of the steps of a sequence: the median of those of a camera that does not stand.
[[nodiscard]] double UsualStep(std::vector<double> steps);

/// How far apart neighbours of a sequence, given by their priors in its order, are by GNSS, metres:
/// the usual step. 0 where no two have positions.
[[nodiscard]] double UsualStep(std::span<const PosePrior* const> sequence);

}  // namespace orbweave
