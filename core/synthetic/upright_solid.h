// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/random.h"
#include "core/synthetic/solid.h"

namespace orbweave {

/// A solid whose lower side is `base_m` above the street's ground; its seed is the next of
/// `random`.
[[nodiscard]] Solid UprightSolid(SolidKind kind,
                                 const Eigen::Vector2d& middle,
                                 const Eigen::Vector2d& along,
                                 const Eigen::Vector3d& size_m,
                                 double base_m,
                                 Random& random);

}  // namespace orbweave
