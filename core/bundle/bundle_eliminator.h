// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/block_elimination.h"
#include "core/bundle/bundle_layout.h"
#include "core/bundle/bundle_options.h"
#include "core/bundle/bundle_problem.h"
#include "core/bundle/bundle_state.h"
#include "core/bundle/gauge.h"
#include "core/bundle/levenberg_marquardt.h"
#include "core/bundle/reduced_system.h"
#include "core/bundle/retained_points.h"
#include "core/bundle/trial_step.h"

namespace orbweave {

/// Variables on which terms outside a problem depend too; indices ascending.
struct RetainedVariables {
  std::vector<uint32_t> poses{};
  std::vector<uint32_t> biases{};
  std::vector<uint32_t> points{};
};

/// A state with what the next step needs of its evaluation.
struct EvaluatedState {
  BundleState variables{};
  PointCosts costs{};  ///< of the points that are eliminated
  /// Of the retained points, where they were before the step that led here.
  std::vector<Eigen::Vector3d> retained_points_before{};
};

/// One problem's part in the judgement of a step.
struct TrialCost {
  double cost = 0.0;                ///< without retained points
  double predicted_decrease = 0.0;  ///< of the eliminated variables
  std::vector<RetainedPointTrial> retained_points{};
};

/// The two halves of a Levenberg-Marquardt step on one problem. Linearise eliminates points in
/// fixed chunks and then poses and biases, all but the retained variables; BackSubstitute turns a
/// step of those into one of all. Nothing retained: both together are the whole step. `problem`,
/// `gauge` outlive the object. Same bytes for any number of threads.
class BundleEliminator {
 public:
  BundleEliminator(const BundleProblem& problem,
                   const Gauge& gauge,
                   const RetainedVariables& retained,
                   const BundleOptions& options,
                   int num_threads);

  BundleEliminator(const BundleEliminator&) = delete;
  BundleEliminator& operator=(const BundleEliminator&) = delete;

  /// The problem's own poses and points, no bias, evaluated.
  [[nodiscard]] EvaluatedState Start() const;

  /// Half the sum of all losses.
  [[nodiscard]] double Cost(const EvaluatedState& state) const;

  /// False when the eliminated part is not positive definite; neither of the two below may be
  /// called then.
  [[nodiscard]] bool Linearise(const EvaluatedState& state, const StepControl& control);

  /// Of the retained blocks: poses, biases, points; undamped.
  [[nodiscard]] NormalSystem Remaining() const { return elimination_.Remaining(system_); }

  /// `state` is that of the last Linearise; `trial` is overwritten. Kept points take the whole of
  /// their step; TrialCost says what shorter ones would cost.
  TrialCost BackSubstitute(const EvaluatedState& state,
                           const std::vector<Vector6>& retained_step,
                           EvaluatedState& trial);

  [[nodiscard]] const BundleLayout& layout() const { return layout_; }

 private:
  const BundleProblem& problem_;
  const Gauge& gauge_;
  int num_threads_;
  RobustLoss loss_;
  BundleLayout layout_;
  BlockElimination elimination_;
  BearingReducer reducer_;
  PointStepper stepper_;
  ReducedSystem system_;
};

/// Poses and points of `state` into `problem`. Held poses and points without observations retained
/// their bits.
void WriteBack(const BundleLayout& layout, const BundleState& state, BundleProblem& problem);

}  // namespace orbweave
