// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/point_choice.h"
#include "core/bundle/reduced_system.h"
#include "core/bundle/robust_loss.h"

namespace orbweave {

/// A retained point's costs over the observations of one problem.
struct RetainedPointTrial {
  double cost_before = 0.0;
  std::array<PointCost, kStepShares.size()> after{};  ///< by share of the step
};

/// Adds the bearings of layout.retained_points to a system whose blocks they are. A point takes a
/// block whose rotation rows stand alone.
void AddRetainedPoints(const BundleLayout& layout,
                       const BundleState& state,
                       const RobustLoss& loss,
                       ReducedSystem& system);

/// Moves the retained points of `trial` by the whole of their step (per block).
void StepRetainedPoints(const BundleLayout& layout,
                        const BundleState& state,
                        const std::vector<Vector6>& step,
                        BundleState& trial);

/// Costs before and after the step from `state` to the poses of `trial`, per retained point.
[[nodiscard]] std::vector<RetainedPointTrial> EvaluateRetainedPoints(
    const BundleLayout& layout,
    const BundleState& state,
    const std::vector<Vector6>& step,
    const BundleState& trial,
    const RobustLoss& loss);

}  // namespace orbweave
