// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/estimators/two_view_hints.h"
#include "core/estimators/two_view_options.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Relative pose of two panoramas from putative matches by RANSAC with local optimisation on
/// bearings: inliers by the angle to the epipolar plane (7) below `max_error_rad` and by cheirality
/// on both spheres (paper 3.3), refined over all inliers; flags pure rotation and planes. Matches
/// at the same place of both panoramas are set aside where the others have a geometry of their own
/// that covers more of the sphere: they show the carrier, not the scene. A pair in which nothing
/// but the carrier matches has no geometry. Nor does the sky count: clouds drift, and have more
/// features than a street. Where half of the inliers are high up and further away than five
/// baselines, what is left without them decides; where that shows nothing although both panoramas
/// have features below, there is no geometry. What is high and far beyond the rest is left out
/// (WithoutSky) unless it stands still. Cameras are taken to stand upright to a few degrees; turned
/// otherwise they lose far matches of one side at most. No geometry has a pair whose inliers are no
/// evidence (EvidenceOf): that a share of the matches agrees says nothing, since wrong ones are
/// found in any number.
/// `bearings_a`, `bearings_b`: unit bearings of all features of the two images, in their camera
/// frames; `matches` index into them. Returns kind kNone (and num_putative) when no geometry is
/// supported. Cancelled when asked to stop. `context.seed` seeds the sampler. With the order
/// kBestFirst, and with a predicted pose, few right matches among many wrong ones are found.
[[nodiscard]] absl::StatusOr<TwoViewGeometry> EstimateTwoView(
    ImagePair pair,
    std::span<const Eigen::Vector3d> bearings_a,
    std::span<const Eigen::Vector3d> bearings_b,
    std::span<const FeatureMatch> matches,
    double max_error_rad,
    const TwoViewOptions& options,
    const StageContext& context,
    const TwoViewHints& hints = {});

}  // namespace orbweave
