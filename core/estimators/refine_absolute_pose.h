// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/geometry/rigid3.h"
#include "core/robust/levenberg_marquardt.h"

namespace orbweave {

constexpr int kMaxRefinementSteps = 20;

/// A step of the pose in the axes of the camera, delta = (theta, gamma): R <- exp(theta) R,
/// C <- C + R^T gamma. A point v = R (P - C) becomes exp(theta) (v - gamma).
[[nodiscard]] Rigid3 MovePose(const Rigid3& cam_from_world,
                              const Eigen::Matrix<double, 6, 1>& delta);

/// Cost of a pose, its gradient and Gauss-Newton matrix for steps of MovePose. Residual of a
/// bearing b that sees the point in direction u = v / |v|: the stereographic image of u in the
/// tangent plane B of b, 2 B^T u / (1 + b.u), of length 2 tan(e / 2) ~ e with e of equation (10).
/// It grows up to the antipode, so that points behind the bearing are drawn to the right side.
/// Cauchy loss of scale `loss_scale_rad`.
[[nodiscard]] Linearisation<6> LineariseTangentResiduals(
    const Rigid3& cam_from_world,
    std::span<const Eigen::Vector3d> bearings,
    std::span<const Eigen::Vector3d> points_in_world,
    double loss_scale_rad);

/// Levenberg-Marquardt on that cost.
[[nodiscard]] Rigid3 MinimiseTangentResiduals(const Rigid3& initial,
                                              std::span<const Eigen::Vector3d> bearings,
                                              std::span<const Eigen::Vector3d> points_in_world,
                                              double loss_scale_rad,
                                              int max_steps);

}  // namespace orbweave
