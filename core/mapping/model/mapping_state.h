// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/mapping/model/correspondence_graph.h"
#include "core/mapping/model/visibility_pyramid.h"

namespace orbweave {

using PointIndex = uint32_t;
constexpr PointIndex kNoPoint = std::numeric_limits<PointIndex>::max();

/// A scene point and the nodes it explains, one per image at most; no nodes: removed.
struct MappedPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< in the world
  std::vector<Node> nodes{};
};

/// The model while it grows. Keeps four things true at all times: a node links to the point that
/// lists it; listed nodes belong to registered images; a point lists at most one node per image
/// and two nodes at least; and every image knows which of its features correspond to a point.
/// All containers are indexed, every loop over them runs in index order.
class MappingState {
 public:
  /// Both arguments must outlive the state.
  MappingState(const ClusterProblem& problem, const CorrespondenceGraph& graph);

  [[nodiscard]] const ClusterProblem& Problem() const { return *problem_; }
  [[nodiscard]] const CorrespondenceGraph& Graph() const { return *graph_; }

  /// Whether the world is east, north and up in metres, and adjustments hold images to their
  /// positions there (AdjustPart).
  [[nodiscard]] bool IsInEnu() const { return position_factor_ > 0.0; }
  /// By what the stated sigmas of positions are then multiplied.
  [[nodiscard]] double PositionFactor() const { return position_factor_; }
  /// Where the image's position is there, if it has one: without what heights of its drive are off.
  [[nodiscard]] Eigen::Vector3d PositionInWorld(ImageSlot image) const {
    return *problem_->images[image].prior.position_in_enu -
           Eigen::Vector3d(0.0, 0.0, height_offset_m_[image]);
  }
  /// `height_offset_m`: per image of the cluster.
  void SetInEnu(double position_factor, std::vector<double> height_offset_m) {
    position_factor_ = position_factor;
    height_offset_m_ = std::move(height_offset_m);
  }

  /// How level cameras are held, where adjustments are to hold them so (AddLevelPriors).
  [[nodiscard]] const std::optional<double>& LevelSigma() const { return level_sigma_rad_; }
  void SetLevelSigma(std::optional<double> sigma_rad) { level_sigma_rad_ = sigma_rad; }

  /// Registered images in order of registration.
  [[nodiscard]] const std::vector<ImageSlot>& Registered() const { return registered_; }
  [[nodiscard]] bool IsRegistered(ImageSlot image) const { return is_registered_[image] != 0; }
  [[nodiscard]] const Rigid3& CamFromWorld(ImageSlot image) const { return poses_[image]; }
  [[nodiscard]] const Eigen::Vector3d& Centre(ImageSlot image) const { return centres_[image]; }
  void Register(ImageSlot image, const Rigid3& cam_from_world);
  /// Removes the image with its observations, and points that lose their second observation.
  void Deregister(ImageSlot image);
  void SetPose(ImageSlot image, const Rigid3& cam_from_world);

  /// Indices of points ever made; those removed list no node.
  [[nodiscard]] PointIndex EndOfPoints() const { return static_cast<PointIndex>(points_.size()); }
  [[nodiscard]] const MappedPoint& Point(PointIndex point) const { return points_[point]; }
  [[nodiscard]] bool Exists(PointIndex point) const { return !points_[point].nodes.empty(); }
  [[nodiscard]] PointIndex PointOf(Node node) const { return point_of_node_[node]; }
  [[nodiscard]] uint32_t NumPoints() const { return num_points_; }
  [[nodiscard]] uint32_t NumObservations() const { return num_observations_; }
  /// Observations in one image.
  [[nodiscard]] uint32_t NumObservations(ImageSlot image) const { return observed_[image]; }
  /// Whether the point is seen by the image.
  [[nodiscard]] bool IsSeenBy(PointIndex point, ImageSlot image) const;

  /// `nodes`: free, in different registered images, two at least.
  PointIndex AddPoint(const Eigen::Vector3d& position, std::span<const Node> nodes);
  void SetPosition(PointIndex point, const Eigen::Vector3d& position);
  /// `node`: free, in a registered image that does not see the point yet.
  void AddObservation(PointIndex point, Node node);
  /// Removes the point too when one observation would remain; returns how many went.
  uint32_t RemoveObservation(PointIndex point, Node node);
  /// Returns how many observations went.
  uint32_t RemovePoint(PointIndex point);

  /// Features of the image that correspond to a node with a point, and how they spread.
  [[nodiscard]] const VisibilityPyramid& Visible(ImageSlot image) const { return visible_[image]; }

 private:
  void Link(PointIndex point, Node node);
  void Unlink(Node node);

  const ClusterProblem* problem_;
  const CorrespondenceGraph* graph_;
  std::vector<ImageSlot> registered_{};
  std::vector<uint8_t> is_registered_{};
  std::vector<Rigid3> poses_{};
  std::vector<Eigen::Vector3d> centres_{};
  std::vector<uint32_t> observed_{};
  std::vector<MappedPoint> points_{};
  std::vector<PointIndex> point_of_node_{};
  std::vector<uint32_t> visible_neighbours_{};  ///< per node: neighbours with a point
  std::vector<uint8_t> cell_of_node_{};
  std::vector<VisibilityPyramid> visible_{};
  double position_factor_ = 0.0;
  std::optional<double> level_sigma_rad_{};
  std::vector<double> height_offset_m_{};
  uint32_t num_points_ = 0;
  uint32_t num_observations_ = 0;
};

/// The images that see a point, ascending.
[[nodiscard]] std::vector<ImageSlot> ImagesThatSee(const MappingState& state, PointIndex point);

/// Angle between the bearing of `node` and the direction to `position`, radians.
[[nodiscard]] double NodeError(const MappingState& state,
                               const Eigen::Vector3d& position,
                               Node node);

/// Whether that is no more than `max_error_px` at the equator of the node's panorama.
[[nodiscard]] bool IsExplained(const MappingState& state,
                               const Eigen::Vector3d& position,
                               Node node,
                               double max_error_px);

/// Whether some two of the nodes' cameras see `position` under an angle in
/// [min_angle_rad, pi - min_angle_rad]: on a sphere a point between two cameras is as ill
/// determined along their baseline as one far away. Nor may one of them be so much closer than the
/// others that it cannot see the same thing (kMaxRangeGap).
[[nodiscard]] bool IsWellSeen(const MappingState& state,
                              const Eigen::Vector3d& position,
                              std::span<const Node> nodes,
                              double min_angle_rad);

/// `pixels` at the equator of the node's panorama as an angle, equation (8).
[[nodiscard]] double AngleFromPixels(const MappingState& state, Node node, double pixels);

}  // namespace orbweave
