// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/mapping/model/mapping_state.h"

#include <algorithm>
#include <cmath>

#include "absl/container/inlined_vector.h"
#include "core/bundle/bearing_error.h"
#include "core/estimators/triangulate_rays.h"
#include "core/geometry/rotation.h"

namespace orbweave {

MappingState::MappingState(const ClusterProblem& problem, const CorrespondenceGraph& graph)
    : problem_(&problem),
      graph_(&graph),
      is_registered_(graph.NumImages(), 0),
      poses_(graph.NumImages()),
      centres_(graph.NumImages(), Eigen::Vector3d::Zero()),
      observed_(graph.NumImages(), 0),
      point_of_node_(graph.NumNodes(), kNoPoint),
      visible_neighbours_(graph.NumNodes(), 0),
      visible_(graph.NumImages()) {
  cell_of_node_.reserve(graph.NumNodes());
  for (const Eigen::Vector3d& bearing : graph.bearing_of_node) {
    cell_of_node_.push_back(VisibilityPyramid::CellOf(bearing));
  }
}

void MappingState::Register(ImageSlot image, const Rigid3& cam_from_world) {
  ORBWEAVE_CHECK(!IsRegistered(image));
  is_registered_[image] = 1;
  registered_.push_back(image);
  SetPose(image, cam_from_world);
}

void MappingState::Deregister(ImageSlot image) {
  ORBWEAVE_CHECK(IsRegistered(image));
  for (Node node = graph_->first_node[image]; node < graph_->first_node[image + 1]; ++node) {
    if (point_of_node_[node] != kNoPoint) RemoveObservation(point_of_node_[node], node);
  }
  is_registered_[image] = 0;
  std::erase(registered_, image);
}

void MappingState::SetPose(ImageSlot image, const Rigid3& cam_from_world) {
  poses_[image] = cam_from_world;
  centres_[image] = cam_from_world.Centre();
}

bool MappingState::IsSeenBy(PointIndex point, ImageSlot image) const {
  return std::ranges::any_of(points_[point].nodes,
                             [&](Node node) { return graph_->image_of_node[node] == image; });
}

PointIndex MappingState::AddPoint(const Eigen::Vector3d& position, std::span<const Node> nodes) {
  ORBWEAVE_CHECK(nodes.size() >= 2);
  const PointIndex point = EndOfPoints();
  points_.push_back({position, {}});
  points_.back().nodes.reserve(nodes.size());
  for (const Node node : nodes) Link(point, node);
  ++num_points_;
  return point;
}

void MappingState::SetPosition(PointIndex point, const Eigen::Vector3d& position) {
  points_[point].position = position;
}

void MappingState::AddObservation(PointIndex point, Node node) {
  ORBWEAVE_CHECK(Exists(point));
  Link(point, node);
}

uint32_t MappingState::RemoveObservation(PointIndex point, Node node) {
  MappedPoint& mapped = points_[point];
  if (mapped.nodes.size() <= 2) return RemovePoint(point);
  std::erase(mapped.nodes, node);
  Unlink(node);
  return 1;
}

uint32_t MappingState::RemovePoint(PointIndex point) {
  std::vector<Node> nodes;
  nodes.swap(points_[point].nodes);
  for (const Node node : nodes) Unlink(node);
  --num_points_;
  return static_cast<uint32_t>(nodes.size());
}

void MappingState::Link(PointIndex point, Node node) {
  const ImageSlot image = graph_->image_of_node[node];
  ORBWEAVE_CHECK(IsRegistered(image) && point_of_node_[node] == kNoPoint);
  ORBWEAVE_CHECK(!IsSeenBy(point, image));
  points_[point].nodes.push_back(node);
  point_of_node_[node] = point;
  ++observed_[image];
  ++num_observations_;
  for (const Node other : graph_->Neighbours(node)) {
    if (visible_neighbours_[other]++ == 0) {
      visible_[graph_->image_of_node[other]].Add(cell_of_node_[other]);
    }
  }
}

void MappingState::Unlink(Node node) {
  point_of_node_[node] = kNoPoint;
  --observed_[graph_->image_of_node[node]];
  --num_observations_;
  for (const Node other : graph_->Neighbours(node)) {
    if (--visible_neighbours_[other] == 0) {
      visible_[graph_->image_of_node[other]].Remove(cell_of_node_[other]);
    }
  }
}

std::vector<ImageSlot> ImagesThatSee(const MappingState& state, PointIndex point) {
  std::vector<ImageSlot> images;
  for (const Node node : state.Point(point).nodes)
    images.push_back(state.Graph().image_of_node[node]);
  std::ranges::sort(images);
  return images;
}

double NodeError(const MappingState& state, const Eigen::Vector3d& position, Node node) {
  const CorrespondenceGraph& graph = state.Graph();
  return BearingError(
      state.CamFromWorld(graph.image_of_node[node]), position, graph.bearing_of_node[node]);
}

bool IsExplained(const MappingState& state,
                 const Eigen::Vector3d& position,
                 Node node,
                 double max_error_px) {
  const CorrespondenceGraph& graph = state.Graph();
  return IsWithinAngle(state.CamFromWorld(graph.image_of_node[node]) * position,
                       graph.bearing_of_node[node],
                       AngleFromPixels(state, node, max_error_px));
}

bool IsWellSeen(const MappingState& state,
                const Eigen::Vector3d& position,
                std::span<const Node> nodes,
                double min_angle_rad) {
  absl::InlinedVector<Eigen::Vector3d, 16> centres;
  for (const Node node : nodes) centres.push_back(state.Centre(state.Graph().image_of_node[node]));
  if (!(RangeGap(position, centres) <= kMaxRangeGap)) return false;
  const double max_abs_cos = std::cos(min_angle_rad);
  for (size_t i = 1; i < centres.size(); ++i) {
    const Eigen::Vector3d ray_i = (position - centres[i]).normalized();
    for (size_t j = 0; j < i; ++j) {
      if (std::abs(ray_i.dot((position - centres[j]).normalized())) <= max_abs_cos) return true;
    }
  }
  return false;
}

double AngleFromPixels(const MappingState& state, Node node, double pixels) {
  return state.Problem().images[state.Graph().image_of_node[node]].camera.AngleFromPixels(pixels);
}

}  // namespace orbweave
