// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/averaging/difference_solver.h"
#include "core/base/stage_context.h"

namespace orbweave {

/// Measured differences x_b - x_a of node values with one column or more.
struct DifferenceGraph {
  uint32_t num_nodes = 0;
  std::vector<GraphEdge> edges{};
  Eigen::MatrixXd differences{};  ///< a row per edge
  Eigen::VectorXd weights{};      ///< per edge, > 0: of the squared residual
};

struct AveragedDifferences {
  Eigen::MatrixXd values{};  ///< a row per node; the smallest node of each connected part: zero
  Eigen::VectorXd error{};   ///< per edge: |x_b - x_a - difference|
};

/// Node values that agree with most differences (AverageByReweighting). Cancelled when asked to
/// stop.
[[nodiscard]] absl::StatusOr<AveragedDifferences> AverageDifferences(const DifferenceGraph& graph,
                                                                     const StageContext& context);

}  // namespace orbweave
