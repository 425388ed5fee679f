// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Per edge: inliers x spread, what is lost when it is cut. An edge with inliers covers one of 64
/// cells at least.
[[nodiscard]] std::vector<double> EdgeWeights(const ViewGraph& graph);

}  // namespace orbweave
