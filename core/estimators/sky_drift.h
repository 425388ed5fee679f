// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "core/estimators/bearing_pairs.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// By how much what is far has turned between two panoramas beyond what their cameras have: the
/// rotation theta (vector, radians, axes of the second camera) that minimises
///   sum rho(|b - exp(theta) R a|^2)
/// over the far pairs, Cauchy's loss of half of max_error_rad. Towers have not turned; clouds drift
/// and take along a pose that is fitted to them: across the way it leans, and a wall to one side
/// hardly tells, since where the camera is higher by as much as the wall seems lower, it fits too.
struct SkyDrift {
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();
  /// Of the turn, and of R, which the scene alone determines: inverse Gauss-Newton matrices times
  /// mean squares of the residuals.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

  /// Whether errors do not explain it: beyond what the chi-squared distribution of three freedoms
  /// has once in a thousand (of a scene of 15 pairs once in fifty).
  [[nodiscard]] bool IsClear() const;
};

/// `scene`: pairs that b_from_a, |translation| = 1, was fitted to, at least six; `far`: others,
/// that may be sky, at least two. Nothing is clear where either leaves the turn open.
[[nodiscard]] SkyDrift MeasureSkyDrift(const BearingPairs& far,
                                       const BearingPairs& scene,
                                       const Rigid3& b_from_a,
                                       double max_error_rad);

}  // namespace orbweave
