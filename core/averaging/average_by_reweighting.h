// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>

#include "core/averaging/difference_solver.h"
#include "core/base/stage_context.h"

namespace orbweave {

/// Node values that are to agree with measured differences, in whatever chart they live.
struct DifferenceModel {
  /// Per edge a row: what x_b - x_a still lacks.
  std::function<Eigen::MatrixXd()> residuals{};
  /// Adds a row per node to the values.
  std::function<void(const Eigen::MatrixXd&)> move{};
};

/// Robust averaging by iteratively reweighted least squares, in two phases: sum of lengths first
/// (L1, which has one minimum where the model is linear and is not led astray by a minority of
/// wrong edges), then a Cauchy loss whose scale is twice the median residual that L1 left. There is
/// no threshold to choose. `weights`: per edge, > 0, of the squared residual; only their ratios
/// matter. After Chatterjee and Govindu, Robust Relative Rotation Averaging, PAMI 2018. Cancelled
/// when asked to stop.
[[nodiscard]] absl::Status AverageByReweighting(DifferenceSolver& solver,
                                                const Eigen::VectorXd& weights,
                                                const DifferenceModel& model,
                                                const StageContext& context);

}  // namespace orbweave
