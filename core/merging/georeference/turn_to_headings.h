// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "core/scene/image_manifest.h"
#include "core/scene/reconstruction.h"

namespace orbweave {

/// By how much an upright model (z up) is to be turned clockwise, seen from above, for its
/// panoramas to look where their stated headings say, radians in [-pi, pi]: the mean of those that
/// agree to 20 degrees on the turn that most agree on. A compass is off by ten degrees, and beside
/// iron by anything: nullopt where fewer than three agree, or no more than half of those that state
/// one. Loose images take no part.
[[nodiscard]] std::optional<double> TurnToHeadings(const Reconstruction& reconstruction,
                                                   const Eigen::Quaterniond& upright_from_world,
                                                   const ImageManifest& manifest);

}  // namespace orbweave
