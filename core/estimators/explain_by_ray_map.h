// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/base/stage_context.h"
#include "core/estimators/bearing_pairs.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// A map p_b ~ M p_a of bearings and the pairs within max_error_rad of it, ascending.
struct RayMap {
  Eigen::Matrix3d M = Eigen::Matrix3d::Identity();
  std::vector<uint32_t> inliers{};
};

/// The rotation that most of the pairs agree on. Looks for explanations of at least `min_share` of
/// the pairs, which a few trials of RANSAC cannot miss; a smaller support may not be the largest
/// there is. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<RayMap> ExplainByRotation(const BearingPairs& pairs,
                                                       double max_error_rad,
                                                       double min_share,
                                                       const StageContext& context);

/// The same for ray homographies: points on one plane.
[[nodiscard]] absl::StatusOr<RayMap> ExplainByHomography(const BearingPairs& pairs,
                                                         double max_error_rad,
                                                         double min_share,
                                                         const StageContext& context);

/// The same for points on one plane where the pose is known (FitRayPlane): three pairs make a
/// sample, so that a plane of two fifths of them is found in two fifths of the trials that
/// a homography takes.
[[nodiscard]] absl::StatusOr<RayMap> ExplainByPlane(const BearingPairs& pairs,
                                                    const Rigid3& b_from_a,
                                                    double max_error_rad,
                                                    double min_share,
                                                    const StageContext& context);

}  // namespace orbweave
