// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges that something spoke against, and the others.
struct SiftedEdges {
  std::vector<ViewEdge> kept{};  ///< in the order given
  std::vector<DroppedEdge> dropped{};
};

}  // namespace orbweave
