// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Per edge: inliers x spread, what is lost when it is cut. An edge with inliers covers one of 64
/// cells at least.
[[nodiscard]] std::vector<double> EdgeWeights(const ViewGraph& graph);

/// Per image: what it adds to the time and memory of a cluster, which grow with its observations,
/// in units of an average image. About as many as its observations are the inliers of its best
/// pair (matches in all its pairs would count a stop of the camera many times over). Half of it is
/// for the image itself, so that no cluster of poor images grows to more than twice the size of
/// others: 1/2 (1 + inliers / mean inliers).
[[nodiscard]] std::vector<double> ImageCosts(const ViewGraph& graph);

}  // namespace orbweave
