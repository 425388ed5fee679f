// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/triangulate_tracks.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "core/estimators/triangulate_rays.h"

namespace orbweave {
namespace {

double Radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// Free neighbours of a node in registered images.
void CollectFreeNeighbours(const MappingState& state, Node node, std::vector<Node>& free) {
  free.clear();
  for (const Node other : state.Graph().Neighbours(node)) {
    if (state.IsRegistered(state.Graph().image_of_node[other]) &&
        state.PointOf(other) == kNoPoint) {
      free.push_back(other);
    }
  }
}

/// The nodes that agree with the point, the best one of each image; `nodes` in node order, so that
/// nodes of one image are neighbours.
std::vector<Node> BestPerImage(const MappingState& state,
                               const std::vector<Node>& nodes,
                               const RobustTriangulation& triangulation) {
  std::vector<Node> best;
  double best_error = 0.0;
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (triangulation.is_inlier[i] == 0) continue;
    const double error = NodeError(state, triangulation.point_in_world, nodes[i]);
    const auto& image_of_node = state.Graph().image_of_node;
    if (best.empty() || image_of_node[best.back()] != image_of_node[nodes[i]]) {
      best.push_back(nodes[i]);
      best_error = error;
    } else if (error < best_error) {
      best.back() = nodes[i];
      best_error = error;
    }
  }
  return best;
}

}  // namespace

bool ContinueTrack(MappingState& state, Node node, const TrackLimits& limits) {
  const ImageSlot image = state.Graph().image_of_node[node];
  double best_error = AngleFromPixels(state, node, limits.max_error_px);
  PointIndex best = kNoPoint;
  for (const Node other : state.Graph().Neighbours(node)) {
    const PointIndex point = state.PointOf(other);
    if (point == kNoPoint || point == best || state.IsSeenBy(point, image)) continue;
    const double error = NodeError(state, state.Point(point).position, node);
    if (error < best_error) {
      best_error = error;
      best = point;
    }
  }
  if (best == kNoPoint) return false;
  state.AddObservation(best, node);
  return true;
}

PointIndex CreatePoint(MappingState& state,
                       Node node,
                       std::span<const Node> others,
                       const TrackLimits& limits) {
  if (others.empty()) return kNoPoint;
  std::vector<Node> nodes(others.begin(), others.end());
  nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  std::vector<Rigid3> cams_from_world;
  std::vector<Eigen::Vector3d> bearings;
  cams_from_world.reserve(nodes.size());
  bearings.reserve(nodes.size());
  for (const Node each : nodes) {
    cams_from_world.push_back(state.CamFromWorld(state.Graph().image_of_node[each]));
    bearings.push_back(state.Graph().bearing_of_node[each]);
  }
  const double min_angle_rad = Radians(limits.min_angle_deg);
  const std::optional<RobustTriangulation> triangulation = TriangulateRobustly(
      cams_from_world, bearings, AngleFromPixels(state, node, limits.max_error_px), min_angle_rad);
  if (!triangulation) return kNoPoint;
  const std::vector<Node> agreeing = BestPerImage(state, nodes, *triangulation);
  if (agreeing.size() < 2 || !std::ranges::binary_search(agreeing, node) ||
      !IsWellSeen(state, triangulation->point_in_world, agreeing, min_angle_rad)) {
    return kNoPoint;
  }
  return state.AddPoint(triangulation->point_in_world, agreeing);
}

uint32_t TriangulateImage(MappingState& state, ImageSlot image, const TrackLimits& limits) {
  const CorrespondenceGraph& graph = state.Graph();
  const uint32_t before = state.NumObservations();
  std::vector<Node> free;
  for (Node node = graph.first_node[image]; node < graph.first_node[image + 1]; ++node) {
    if (state.PointOf(node) != kNoPoint || ContinueTrack(state, node, limits)) continue;
    CollectFreeNeighbours(state, node, free);
    CreatePoint(state, node, free, limits);
  }
  return state.NumObservations() - before;
}

}  // namespace orbweave
