// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Per edge: inliers x spread, what is lost when it is cut. An edge with inliers covers one of 64
/// cells at least.
[[nodiscard]] std::vector<double> EdgeWeights(const ViewGraph& graph);

/// Per image: what it will cost to reconstruct, in units of the mean over images with an edge. Time
/// and memory of a cluster grow with its observations, hence with its matches; the cost is kept
/// within a quarter and four times the mean, so that no cluster grows without bounds where images
/// show little.
[[nodiscard]] std::vector<double> ImageCosts(const ViewGraph& graph);

}  // namespace orbweave
