// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "core/averaging/difference_solver.h"

namespace orbweave {

/// One edge of a forest, walked from a node that is reached already to one that is not.
struct ForestStep {
  uint32_t edge = 0;
  uint32_t from = 0;
  uint32_t to = 0;
};

/// The maximum spanning forest by `strength` (per edge; among equals the earlier edge), walked
/// outward from its roots breadth first. `is_root`: per node; what no root reaches is not walked.
[[nodiscard]] std::vector<ForestStep> WalkSpanningForest(const std::vector<GraphEdge>& edges,
                                                         const Eigen::VectorXd& strength,
                                                         std::span<const uint8_t> is_root);

}  // namespace orbweave
