// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// The general edges of `graph` of whose two images no cluster has both, in its order: no cluster's
/// reconstruction takes part of them, so that they bear witness of how clusters were put together.
[[nodiscard]] std::vector<CrossingPair> CrossingPairs(const ViewGraph& graph,
                                                      const Partition& partition);

}  // namespace orbweave
