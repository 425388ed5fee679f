// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

namespace orbweave {

/// The mean of unit directions by Cauchy's weights on the angles from it, reweighted ten times from
/// `start` on: of those that lie together, whatever the others do. Unit.
[[nodiscard]] Eigen::Vector3d RobustMeanDirection(std::span<const Eigen::Vector3d> directions,
                                                  const Eigen::Vector3d& start,
                                                  double loss_scale_deg);

}  // namespace orbweave
