// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/merging/align_submodels.h"
#include "core/scene/reconstruction.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// The features of an image as rays.
struct ImageRays {
  ImageId id{};
  std::span<const Eigen::Vector3d> bearings{};  ///< per feature, unit
  std::span<const float> sigma_rad{};           ///< per feature
};

/// Joins components of one cluster, which have no image in common, by the verified pairs between
/// them. An image of one component is lent to another when 8 points of that, which its pairs say it
/// sees, give it one pose (EstimateAbsolutePose) that a quarter of them agree with: too few to
/// register it when the component grew, but not by chance. Where two components lend each other
/// three images or more, they are submodels that share images: FitSeams, AlignSubmodels and
/// MergeSubmodels join those that agree.
///
/// `components`: each image in at most one; `images`: those of the cluster, by id; `pairs`: among
/// them, sorted. Leaves components in frames of their own, most images first, each image in at most
/// one. Points that both sides saw are one where they agree. Components that nothing joins stay as
/// they are. Deterministic; cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::vector<Reconstruction>> JoinComponents(
    std::vector<Reconstruction> components,
    std::span<const ImageRays> images,
    std::span<const TwoViewGeometry> pairs,
    const AlignOptions& options,
    const StageContext& context);

}  // namespace orbweave
