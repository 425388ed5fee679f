// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"

namespace orbweave {

/// Least-squares similarity of the camera centres, FitSimilarity. Where the centres of one side lie
/// within a hundredth of their length of a line, they say nothing about the roll about it: then
/// points on the cameras' axes, a hundredth of the length away, are fitted with them, so that the
/// rotations do. `weights` empty: all one. nullopt for fewer than three cameras or one place.
[[nodiscard]] std::optional<Sim3> AlignCameras(std::span<const Rigid3> cams_from_a,
                                               std::span<const Rigid3> cams_from_b,
                                               std::span<const double> weights);

}  // namespace orbweave
