// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/robust/levenberg_marquardt.h"

namespace orbweave {

/// Matches of an image with one whose pose is known: unit bearings in the two camera frames.
struct ViewMatches {
  Rigid3 view_from_world{};  ///< known
  std::vector<Eigen::Vector3d> in_view{};
  std::vector<Eigen::Vector3d> in_image{};
};

/// Cost of an image's pose against views of known poses, its gradient and Gauss-Newton matrix for
/// steps of MovePose. Residual of a match: the sine of its symmetric epipolar angle
/// (SymmetricEpipolarAngle), r = T.(q x p) / sqrt(1 - ((T.q)^2 + (T.p)^2) / 2), with q the bearing
/// of the view turned into the image, p that of the image and T the direction of the view's centre.
/// Directions of parallel baselines leave the centre along them open. Cauchy loss of scale
/// `loss_scale_rad`.
[[nodiscard]] Linearisation<6> LineariseBetweenViews(const Rigid3& cam_from_world,
                                                     std::span<const ViewMatches> views,
                                                     double loss_scale_rad);

/// Levenberg-Marquardt on that cost and, as far as there are any, on that of scene points
/// (LineariseTangentResiduals): `bearings` in the image see `points_in_world`.
[[nodiscard]] Rigid3 MinimiseBetweenViews(const Rigid3& initial,
                                          std::span<const ViewMatches> views,
                                          std::span<const Eigen::Vector3d> bearings,
                                          std::span<const Eigen::Vector3d> points_in_world,
                                          double loss_scale_rad,
                                          int max_steps);

}  // namespace orbweave
