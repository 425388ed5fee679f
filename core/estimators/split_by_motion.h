// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/scene/ids.h"

namespace orbweave {

/// Matches of two panoramas of one mount, in the order given. What is at the same place of both is
/// the carrier itself (its roof, a mast), or the camera stood still.
struct MatchesByMotion {
  std::vector<FeatureMatch> moved{};
  std::vector<FeatureMatch> fixed{};  ///< bearings no more than max_angle_rad apart
  double fixed_spread = 0.0;          ///< SphereSpread of the fixed ones in image a
};

[[nodiscard]] MatchesByMotion SplitByMotion(std::span<const Eigen::Vector3d> bearings_a,
                                            std::span<const Eigen::Vector3d> bearings_b,
                                            std::span<const FeatureMatch> matches,
                                            double max_angle_rad);

}  // namespace orbweave
