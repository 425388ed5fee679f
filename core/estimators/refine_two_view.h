// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/geometry/rigid3.h"
#include "core/robust/levenberg_marquardt.h"

namespace orbweave {

/// A step on SO(3) x S^2, delta = (theta, tau): R <- exp(theta) R, T <- T + B tau normalised, B the
/// tangent plane of the unit vector T.
[[nodiscard]] Rigid3 MoveRelativePose(const Rigid3& b_from_a,
                                      const Eigen::Matrix<double, 5, 1>& delta);

/// Cost of a relative pose with |T| = 1, its gradient and Gauss-Newton matrix for steps of
/// MoveRelativePose. Residual: the signed sine of SymmetricEpipolarAngle, under a Cauchy loss of
/// scale `loss_scale_rad`. All four poses of an essential matrix have the same cost.
[[nodiscard]] Linearisation<5> LineariseEpipolarResiduals(
    const Rigid3& b_from_a,
    std::span<const Eigen::Vector3d> bearings_a,
    std::span<const Eigen::Vector3d> bearings_b,
    double loss_scale_rad);

/// Levenberg-Marquardt on that cost.
[[nodiscard]] Rigid3 MinimiseEpipolarResiduals(const Rigid3& initial,
                                               std::span<const Eigen::Vector3d> bearings_a,
                                               std::span<const Eigen::Vector3d> bearings_b,
                                               double loss_scale_rad,
                                               int max_steps);

}  // namespace orbweave
