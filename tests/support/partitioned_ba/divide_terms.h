// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/bundle_problem.h"
#include "core/bundle/gauge.h"

namespace orbweave {

/// The terms of one subproblem, by their indices in the whole problem, ascending.
struct SubproblemTerms {
  std::vector<uint32_t> observations{};
  std::vector<uint32_t> position_priors{};
  std::vector<uint32_t> direction_priors{};
  std::vector<uint32_t> bias_priors{};  ///< groups
};

/// Gives every term to one subproblem; see DivideBundle.
[[nodiscard]] std::vector<SubproblemTerms> DivideTerms(const BundleProblem& problem,
                                                       const Gauge& gauge,
                                                       const std::vector<uint32_t>& owner_of_pose,
                                                       uint32_t num_subproblems);

}  // namespace orbweave
