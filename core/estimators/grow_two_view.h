// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// A verified geometry (EstimateTwoView) with more matches, found along its planes: its pose
/// refined over those of `matches` that agree with it, which become its inliers; or as it was where
/// these are no more than it has. What the geometry had left out stays out, since it would come
/// back with matches along its own planes: what is at the same place of both panoramas, the
/// carrier, which lies on every plane of cameras that have not turned; and what is high and far
/// (WithoutSky), clouds that drift. Kind, evidence and rung stay. `seed` as for EstimateTwoView;
/// kinds with a baseline.
[[nodiscard]] TwoViewGeometry GrowTwoView(const TwoViewGeometry& geometry,
                                          std::span<const Eigen::Vector3d> bearings_a,
                                          std::span<const Eigen::Vector3d> bearings_b,
                                          std::span<const FeatureMatch> matches,
                                          double max_error_rad,
                                          uint64_t seed);

}  // namespace orbweave
