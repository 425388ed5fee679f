// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "absl/container/inlined_vector.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// Half-line C + lambda d, lambda > 0.
struct Ray {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit
};

/// Rays of one scene point; the usual track needs no memory from the heap.
using Rays = absl::InlinedVector<Ray, 8>;

/// Rays with the axes of the world and the origin in the first camera: far from the world's origin
/// no digits are lost. `bearings` unit, in their camera frames; at least one.
[[nodiscard]] Rays RaysFromFirstCamera(std::span<const Rigid3> cams_from_world,
                                       std::span<const Eigen::Vector3d> bearings);

/// The point X that minimises the sum of squared sines of the angles between d_i and X - C_i.
/// Start: the point nearest to the lines, sum (I - d d^T)(X - C) = 0; then Gauss-Newton. nullopt
/// for fewer than two rays, for parallel or opposite ones (within 1e-6 rad), and for points that
/// are not in front of every ray, d.(X - C) > 0.
[[nodiscard]] std::optional<Eigen::Vector3d> IntersectRays(const Rays& rays);

}  // namespace orbweave
