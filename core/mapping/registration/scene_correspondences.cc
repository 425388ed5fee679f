// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/registration/scene_correspondences.h"

#include <algorithm>

#include "core/geometry/rotation.h"

namespace orbweave {
namespace {

template <typename T>
size_t CountDifferent(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return static_cast<size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

}  // namespace

SceneCorrespondences FindSceneCorrespondences(const MappingState& state, ImageSlot image) {
  const CorrespondenceGraph& graph = state.Graph();
  SceneCorrespondences found;
  std::vector<PointIndex> points;
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    points.clear();
    for (const Node other : graph.Neighbours(node)) {
      const PointIndex point = state.PointOf(other);
      if (point == kNoPoint || std::ranges::count(points, point) > 0) continue;
      points.push_back(point);
      found.nodes.push_back(node);
      found.points.push_back(point);
      found.bearings.push_back(graph.bearing_of_node[node]);
      found.positions.push_back(state.Point(point).position);
    }
  }
  return found;
}

PoseSupport SupportOf(const Rigid3& cam_from_world,
                      const SceneCorrespondences& correspondences,
                      double max_error_rad) {
  PoseSupport support;
  support.is_inlier.resize(correspondences.size(), 0);
  std::vector<Node> nodes;
  std::vector<PointIndex> points;
  for (size_t i = 0; i < correspondences.size(); ++i) {
    if (IsWithinAngle(cam_from_world * correspondences.positions[i],
                      correspondences.bearings[i],
                      max_error_rad)) {
      support.is_inlier[i] = 1;
      nodes.push_back(correspondences.nodes[i]);
      points.push_back(correspondences.points[i]);
    }
  }
  support.count = static_cast<uint32_t>(
      std::min(CountDifferent(std::move(nodes)), CountDifferent(std::move(points))));
  return support;
}

}  // namespace orbweave
