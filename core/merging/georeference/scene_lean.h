// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/partitioned_ba/subproblem.h"

namespace orbweave {

/// Points of a subproblem as seen from the nearest of the panoramas that see them: point minus
/// centre, world axes. At most a thousand, evenly over its tracks. What stands and lies about
/// panoramas knows what is upright where neither GNSS nor the panoramas do.
[[nodiscard]] std::vector<Eigen::Vector3d> PointsAboutPanoramas(const Subproblem& subproblem);

/// By how much a scene leans.
struct SceneLean {
  double lean_rad =
      0.0;  ///< about the axis, right-handed: turning back by it sets the scene upright
  double sharpness = 0.0;  ///< of planes there, over that of a model that does not lean
};

/// Streets are level beside the way and houses plumb: turned about the way by the right angle,
/// points of ground and walls fall into few bins of height and of distance to the side. Angles up
/// to 20 degrees are tried; a bin counts by what it has above its neighbours and above chance,
/// squared. `axis`: along the way, horizontal unit vector, `points` in metres from the panoramas.
/// nullopt where nothing stands out at any angle.
[[nodiscard]] std::optional<SceneLean> MeasureSceneLean(std::span<const Eigen::Vector3d> points,
                                                        const Eigen::Vector3d& axis);

}  // namespace orbweave
