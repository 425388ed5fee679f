// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/bundle_problem.h"
#include "core/bundle/gauge.h"

namespace orbweave {

/// A variable of the whole problem on which the terms of two subproblems or more depend; every
/// other variable is interior of the one subproblem that uses it.
struct SeparatorId {
  enum class Kind : uint8_t { kPose, kBias, kPoint };
  Kind kind = Kind::kPose;
  uint32_t index = 0;  ///< in the whole problem
  friend auto operator<=>(const SeparatorId&, const SeparatorId&) = default;
};

/// A share of a bundle problem: some of its terms, and all variables that they need. The cost of
/// the whole problem is the sum of the subproblems' costs. A prior that another subproblem counts
/// is there as a bias sigma of infinity.
struct BundleSubproblem {
  BundleProblem problem{};  ///< with indices of its own; its priors and observations are disjoint
                            ///< from the other subproblems'
  Gauge gauge{};            ///< the whole problem's, restricted to this subproblem
  std::vector<uint32_t> pose_ids{};       ///< per pose: in the whole problem; ascending
  std::vector<uint32_t> point_ids{};      ///< per point; ascending
  std::vector<uint32_t> bias_ids{};       ///< per bias group; ascending
  std::vector<SeparatorId> separators{};  ///< ascending: poses, biases, points
};

}  // namespace orbweave
