// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/base/stage_context.h"
#include "core/base/status.h"
#include "core/scene/two_view_geometry.h"

namespace orbweave {

/// Matches elsewhere on both spheres than the plane that carries a two-view geometry, in the order
/// given: of `matches` those outside the cells (16 x 16 of equal area) that hold two inliers of the
/// plane or more, so that sills and frames before a facade go with it. A facade whose windows
/// repeat fits a whole window further on as well as where it is, and often better, since each
/// window is then seen from the same side; only what is elsewhere can tell. nullopt: no plane holds
/// two fifths of the inliers. The plane is the one (ExplainByPlane) that most inliers with
/// parallax agree with. Cancelled when asked to stop.
[[nodiscard]] absl::StatusOr<std::optional<std::vector<FeatureMatch>>> MatchesBesidesPlane(
    std::span<const Eigen::Vector3d> bearings_a,
    std::span<const Eigen::Vector3d> bearings_b,
    std::span<const FeatureMatch> matches,
    const TwoViewGeometry& geometry,
    double max_error_rad,
    const StageContext& context);

}  // namespace orbweave
