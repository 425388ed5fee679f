// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/mapping/model/cluster_problem.h"

namespace orbweave {

/// The problem with a sigma of one pixel for every observation, as the paper's cost (11) weighs
/// them; nullopt when it is so already.
[[nodiscard]] std::optional<ClusterProblem> WeighPixelsAlike(const ClusterProblem& problem);

}  // namespace orbweave
