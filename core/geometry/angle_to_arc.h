// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace orbweave {

/// In radians, between a direction and the nearest of the arc from `first` to `last`, which are the
/// directions of x first + y last with x, y >= 0. All unit vectors; where these two are opposite,
/// no arc between them is told from another, and it is the nearer of both.
[[nodiscard]] double AngleToArc(const Eigen::Vector3d& direction,
                                const Eigen::Vector3d& first,
                                const Eigen::Vector3d& last);

}  // namespace orbweave
