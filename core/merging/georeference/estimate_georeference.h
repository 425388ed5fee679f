// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "absl/status/statusor.h"
#include "core/base/stage_context.h"
#include "core/geometry/sim3.h"
#include "core/merging/georeference/estimate_gravity.h"
#include "core/merging/georeference/gnss_positions.h"

namespace orbweave {

/// Sum of squared horizontal residuals in sigmas, each 9 (three sigmas) at most: a mount that leans
/// lifts the ends of a model far off.
[[nodiscard]] double HorizontalCost(const GnssPositions& positions, const Sim3& enu_from_world);

/// The same positions of a model that is turned about its origin.
[[nodiscard]] GnssPositions Turned(const Eigen::Quaterniond& rotation, GnssPositions positions);

/// Yaw, scale and translation of a model that stands upright: of random pairs of positions those
/// of least HorizontalCost, and the height in the median. nullopt where all are one point.
[[nodiscard]] absl::StatusOr<std::optional<Sim3>> EstimateUpright(const GnssPositions& upright,
                                                                  const StageContext& context);

/// The same of a model with down where gravity says.
[[nodiscard]] absl::StatusOr<std::optional<Sim3>> EstimateLevel(const GnssPositions& positions,
                                                                const Gravity& gravity,
                                                                const StageContext& context);

/// Whether no mount leans so far (kMaxLean_rad).
[[nodiscard]] bool LeansTooFar(const Gravity& gravity, const Sim3& enu_from_world);

/// All seven parameters (RefineGeoreference), from EstimateLevel, where they stay when refining
/// leans too far, or without gravity from EstimateSimilarity.
[[nodiscard]] absl::StatusOr<std::optional<Sim3>> EstimateGeoreference(
    const GnssPositions& positions,
    const std::optional<Gravity>& gravity,
    const StageContext& context);

}  // namespace orbweave
