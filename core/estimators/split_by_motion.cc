// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/estimators/split_by_motion.h"

#include <cmath>

#include "core/geometry/sphere_cells.h"

namespace orbweave {

MatchesByMotion SplitByMotion(std::span<const Eigen::Vector3d> bearings_a,
                              std::span<const Eigen::Vector3d> bearings_b,
                              std::span<const FeatureMatch> matches,
                              double max_angle_rad) {
  const double max_squared_chord = 2.0 - 2.0 * std::cos(max_angle_rad);
  MatchesByMotion split;
  std::vector<Eigen::Vector3d> fixed_in_a;
  for (const FeatureMatch& match : matches) {
    const bool is_fixed =
        (bearings_a[match.a] - bearings_b[match.b]).squaredNorm() <= max_squared_chord;
    (is_fixed ? split.fixed : split.moved).push_back(match);
    if (is_fixed) fixed_in_a.push_back(bearings_a[match.a]);
  }
  split.fixed_spread = SphereSpread(fixed_in_a);
  return split;
}

}  // namespace orbweave
