// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "core/mapping/model/cluster_problem.h"
#include "core/scene/reconstruction.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// The general pairs of a cluster of whose two images none of its submodels has both, in its order.
/// Where a street was cut in two, or never held together, they lead across the gap; what else puts
/// its sides into one model, another cluster or GNSS, has not been held against them.
[[nodiscard]] std::vector<CrossingPair> PartedPairs(const ClusterProblem& problem,
                                                    std::span<const Reconstruction> submodels);

}  // namespace orbweave
