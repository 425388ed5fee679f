// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/graph/grow_overlap.h"
#include "core/scene/view_graph.h"

namespace orbweave {

/// Clusters from their interiors (sorted lists of images, disjoint, together all images with an
/// edge): each borrows from its neighbours what GrowOverlap says.
[[nodiscard]] Partition OverlapClusters(const ViewGraph& graph,
                                        const std::vector<std::vector<uint32_t>>& interiors,
                                        const OverlapTargets& targets);

}  // namespace orbweave
