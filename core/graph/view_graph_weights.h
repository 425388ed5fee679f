// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Per edge: inliers x spread, what is lost when it is cut. An edge with inliers covers one of 64
/// cells at least.
[[nodiscard]] std::vector<double> EdgeWeights(const ViewGraph& graph);

/// Per image: what it adds to the time and memory of a cluster, which both grow with the inlier
/// matches, in units of the median of all images with an edge; between 1/2 and 2, so that clusters
/// of costly images keep enough of them. 1 for images without an edge.
[[nodiscard]] std::vector<double> ImageCosts(const ViewGraph& graph);

/// Per image the first of those it stands still with: joined by pairs of one centre
/// (TwoViewKind::kPureRotation), strongest pairs first, no more together than `max_images` of them
/// says (per image). A cluster cut out of the middle of a stop would have no baseline.
[[nodiscard]] std::vector<uint32_t> StandingGroups(const ViewGraph& graph,
                                                   std::span<const uint32_t> max_images);

}  // namespace orbweave
