// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/scene/view_graph.h"

namespace orbweave {

/// Edges that something spoke against, and the others.
struct SiftedEdges {
  std::vector<ViewEdge> kept{};  ///< in the order given
  std::vector<DroppedEdge> dropped{};
};

/// `fault_of(e)`: why edges[e] is dropped for `cause`; empty: it is kept.
template <typename FaultOf>
[[nodiscard]] SiftedEdges SiftEdges(const std::vector<ViewEdge>& edges,
                                    DropCause cause,
                                    FaultOf&& fault_of) {
  SiftedEdges sifted;
  for (uint32_t e = 0; e < edges.size(); ++e) {
    std::string fault = fault_of(e);
    if (fault.empty()) {
      sifted.kept.push_back(edges[e]);
    } else {
      sifted.dropped.push_back({edges[e].pair, std::move(fault), cause});
    }
  }
  return sifted;
}

}  // namespace orbweave
