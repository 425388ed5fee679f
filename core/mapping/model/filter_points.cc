// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/filter_points.h"

#include <numbers>

namespace orbweave {
namespace {

uint32_t RemoveWrongObservations(MappingState& state, PointIndex point, double max_error_px) {
  const std::vector<Node> nodes = state.Point(point).nodes;
  uint32_t removed = 0;
  for (const Node node : nodes) {
    if (IsExplained(state, state.Point(point).position, node, max_error_px)) continue;
    removed += state.RemoveObservation(point, node);
    if (!state.Exists(point)) break;
  }
  return removed;
}

}  // namespace

uint32_t FilterPoints(MappingState& state,
                      std::span<const PointIndex> points,
                      const TrackLimits& limits) {
  const double min_angle_rad = limits.min_angle_deg * std::numbers::pi / 180.0;
  uint32_t removed = 0;
  for (const PointIndex point : points) {
    if (!state.Exists(point)) continue;
    removed += RemoveWrongObservations(state, point, limits.max_error_px);
    const MappedPoint& mapped = state.Point(point);
    if (state.Exists(point) && !IsWellSeen(state, mapped.position, mapped.nodes, min_angle_rad)) {
      removed += state.RemovePoint(point);
    }
  }
  return removed;
}

std::vector<PointIndex> AllPoints(const MappingState& state) {
  std::vector<PointIndex> points;
  points.reserve(state.NumPoints());
  for (PointIndex point = 0; point < state.EndOfPoints(); ++point) {
    if (state.Exists(point)) points.push_back(point);
  }
  return points;
}

}  // namespace orbweave
