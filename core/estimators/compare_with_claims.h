// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>

#include "core/geometry/rigid3.h"

namespace orbweave {

/// What a camera may be off besides what its sigma allows, units of the reference: metres.
inline constexpr double kMisplacedSlack = 0.05;

/// How the errors of cameras compare with what their sigmas claim.
struct ClaimErrors {
  /// Mean over cameras of squared error over claimed variance, per axis of the world: 1 where
  /// sigmas are true.
  Eigen::Vector3d squared_over_variance = Eigen::Vector3d::Zero();
  size_t cameras = 0;
  /// Cameras that are misplaced: off by more than three of their sigmas (the norm of all axes') and
  /// `kMisplacedSlack`.
  size_t misplaced = 0;
  bool is_relative = false;  ///< to the camera whose sigmas are zero; else absolute
};

/// Sigmas (world axes and units) refer to a frame: where one camera has none at all, its pose and
/// its distance to the camera farthest from it are exact, and the reference is brought there by the
/// similarity that makes them so; these two do not count. Otherwise the frames are the same as they
/// are. Without a single camera to judge: nullopt. All spans are of one size.
[[nodiscard]] std::optional<ClaimErrors> CompareWithClaims(
    std::span<const Rigid3> cams_from_model,
    std::span<const Eigen::Vector3d> sigmas,
    std::span<const Rigid3> cams_from_reference);

}  // namespace orbweave
