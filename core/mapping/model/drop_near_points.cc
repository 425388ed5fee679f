// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/drop_near_points.h"

#include <utility>
#include <vector>

#include "core/base/quantile.h"

namespace orbweave {
namespace {

/// Of the median depth. On a street that is the width of a hand.
constexpr double kNearest = 0.01;

uint32_t DropNearImage(MappingState& state, ImageSlot image) {
  const CorrespondenceGraph& graph = state.Graph();
  std::vector<std::pair<PointIndex, double>> depths;
  std::vector<double> sorted;
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    const PointIndex point = state.PointOf(node);
    if (point == kNoPoint) continue;
    depths.emplace_back(point, (state.Point(point).position - state.Centre(image)).norm());
    sorted.push_back(depths.back().second);
  }
  if (depths.empty()) return 0;
  const double nearest = kNearest * UpperMedian(std::move(sorted));
  uint32_t removed = 0;
  for (const auto& [point, depth] : depths) {
    if (depth < nearest) removed += state.RemovePoint(point);
  }
  return removed;
}

}  // namespace

uint32_t DropNearPoints(MappingState& state, std::span<const ImageSlot> images) {
  uint32_t removed = 0;
  for (const ImageSlot image : images) removed += DropNearImage(state, image);
  return removed;
}

}  // namespace orbweave
