// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/estimators/bearing_pairs.h"
#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"

namespace orbweave {

/// Matches of two panoramas that stand more or less upright, in the order given. What is high may
/// be sky: clouds drift, so that panoramas taken seconds apart see them move as if the camera had
/// gone elsewhere, and those taken far apart as if it had stood. What is below is the scene.
struct MatchesByHeight {
  std::vector<FeatureMatch> low{};   ///< in both panoramas at most kSkyElevation above the horizon
  std::vector<FeatureMatch> high{};  ///< all others
};

/// Five degrees, radians: three standard deviations of the tilt of a car. Hills and houses cover
/// the end of the street up to there, and the scene has the ground and half of the ground floors
/// below.
constexpr double kSkyElevation_rad = 0.0873;

[[nodiscard]] bool IsHigh(const Eigen::Vector3d& bearing);
/// Whether one of two bearings of a match is.
[[nodiscard]] bool IsEitherHigh(const Eigen::Vector3d& bearing_a, const Eigen::Vector3d& bearing_b);

[[nodiscard]] MatchesByHeight SplitByHeight(std::span<const Eigen::Vector3d> bearings_a,
                                            std::span<const Eigen::Vector3d> bearings_b,
                                            std::span<const FeatureMatch> matches);

/// Baseline over depth, sin(parallax) / sin(angle between baseline and ray): 0 for what is
/// infinitely far, infinite along the baseline, where the depth is unknown. |translation| = 1.
[[nodiscard]] double InverseDepth(const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b,
                                  const Rigid3& b_from_a);

/// Those of `inliers` (indices of pairs) that may not be sky. High ones are taken out that lie
/// eight times as far as low ones do in the median, or nowhere else than at infinity as far as
/// `max_error_rad` tells. Empty where low ones do not show three times that error themselves: they
/// cannot tell.
[[nodiscard]] std::vector<uint32_t> WithoutSky(const BearingPairs& pairs,
                                               std::span<const uint32_t> inliers,
                                               const Rigid3& b_from_a,
                                               double max_error_rad);

}  // namespace orbweave
