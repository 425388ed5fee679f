// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/estimators/bearing_pairs.h"
#include "core/estimators/resolve_cheirality.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Directions of baselines that are closer than this, fifteen degrees, are one motion, measured
/// twice.
inline constexpr double kOneDirection_rad = 0.26;

/// Whether a match moved by more than the rotation and errors explain: what is far shows no
/// baseline, and fits every direction of one.
[[nodiscard]] bool HasClearlyMoved(const Eigen::Quaterniond& rotation,
                                   const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b,
                                   double max_error_rad);

/// Some of `pairs`, as pairs of their own.
[[nodiscard]] BearingPairs Subset(const BearingPairs& pairs, std::span<const uint32_t> indices);

/// Inliers of a pose: within max_error_rad of the epipolar planes and in front of both spheres.
[[nodiscard]] std::vector<uint32_t> InliersOf(const BearingPairs& pairs,
                                              const Rigid3& b_from_a,
                                              double max_error_rad);

/// The pose that fits some pairs best, from one close by; robust, residuals of half of
/// max_error_rad count as noise.
[[nodiscard]] Rigid3 RefinePose(const BearingPairs& pairs,
                                std::span<const uint32_t> indices,
                                const Rigid3& b_from_a,
                                double max_error_rad);

/// Alternates pose and inliers until these do not grow any more.
[[nodiscard]] ResolvedPose RefineToConvergence(const BearingPairs& pairs,
                                               ResolvedPose best,
                                               double max_error_rad);

/// Takes over what the inliers are, and what follows from them: spread and median angle under
/// geometry.b_from_a. `inliers` are pairs of `matches`.
void SetInliers(const BearingPairs& inliers,
                std::span<const FeatureMatch> matches,
                TwoViewGeometry& geometry);

}  // namespace orbweave
