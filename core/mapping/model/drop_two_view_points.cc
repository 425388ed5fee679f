// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_two_view_points.h"

#include <algorithm>

namespace orbweave {
namespace {

/// Per image, its observations of points that three images or more see.
std::vector<int> CountConfirmed(const MappingState& state) {
  std::vector<int> counts(state.Graph().NumImages(), 0);
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    if (state.Point(point).nodes.size() < 3) continue;
    for (const Node node : state.Point(point).nodes) ++counts[state.Graph().image_of_node[node]];
  }
  return counts;
}

}  // namespace

uint32_t DropTwoViewPoints(MappingState& state, double max_error_px, int enough) {
  const std::vector<int> confirmed = CountConfirmed(state);
  uint32_t dropped = 0;
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    const MappedPoint& mapped = state.Point(point);
    if (mapped.nodes.size() != 2) continue;
    const bool is_exact = std::ranges::all_of(mapped.nodes, [&](Node node) {
      return IsExplained(state, mapped.position, node, max_error_px);
    });
    const bool is_needed = std::ranges::any_of(mapped.nodes, [&](Node node) {
      return confirmed[state.Graph().image_of_node[node]] < enough;
    });
    if (is_exact && is_needed) continue;
    state.RemovePoint(point);
    ++dropped;
  }
  return dropped;
}

}  // namespace orbweave
