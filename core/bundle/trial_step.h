// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/point_choice.h"
#include "core/bundle/reduced_system.h"
#include "core/bundle/robust_loss.h"

namespace orbweave {

/// Half the sum of losses of each point's observations, per layout.points.
struct PointCosts {
  std::vector<double> per_point{};
  double total = 0.0;
};

/// One point's cost at `point_in_world`.
[[nodiscard]] PointCost EvaluatePointCost(const BundleLayout& layout,
                                          const PackedPoint& point,
                                          const Eigen::Vector3d& point_in_world,
                                          const std::vector<PoseState>& poses,
                                          const RobustLoss& loss);

[[nodiscard]] PointCosts EvaluatePointCosts(const BundleLayout& layout,
                                            const BundleState& state,
                                            const RobustLoss& loss,
                                            int num_threads);

/// Sets poses and biases of `trial` to those of `state` after `step` (per block); leaves its
/// points.
void StepBlocks(const BundleLayout& layout,
                const BundleState& state,
                const std::vector<Vector6>& step,
                BundleState& trial);

/// Back-substitutes the points into `trial` (from StepBlocks) and evaluates their costs there:
///   (V + mu I) x = -(g_point + W^T step).
/// A point takes as much of its step as ChoosePointStep says.
class PointStepper {
 public:
  PointStepper(const BundleLayout& layout, int num_threads);

  /// Returns the points' part of the decrease that the linear model predicts.
  double StepPoints(const BundleState& state,
                    const RobustLoss& loss,
                    const std::vector<Vector6>& step,
                    const ReducedSystem& system,
                    const PointCosts& costs,
                    BundleState& trial,
                    PointCosts& trial_costs);

 private:
  const BundleLayout& layout_;
  int num_threads_ = 1;
  std::vector<double> chunk_decrease_{};
};

}  // namespace orbweave
