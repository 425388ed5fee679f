// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/averaging/average_differences.h"
#include "core/mapping/model/correspondence_graph.h"

namespace orbweave {

/// Where images are.
struct EnuPlacement {
  /// How the frame of the displacements is turned.
  Eigen::Quaterniond enu_from_world = Eigen::Quaterniond::Identity();
  Eigen::MatrixXd centres{};  ///< a row per image of the cluster, in metres
  /// Per image of the cluster, what the heights of its drive are off: drives may refer to different
  /// datums, which nothing tells beforehand.
  std::vector<double> height_offset_m{};
  /// By how much positions scatter about the centres, over what they state; 1 at least.
  double scatter = 1.0;
};

/// Centres of images in east, north and up that agree with their displacements, which are in metres
/// but in a frame turned somehow (EnuFromDisplacements), and with their GNSS positions:
/// AverageDifferences with positions as differences from the origin, horizontally and, for itself,
/// up, where each drive has an origin of its own; displacements are taken for good to a tenth of
/// their length, more or less as their weights differ. Receivers promise too much between houses:
/// positions are then held for as exact as they prove, and centres sought once more.
///
/// `images`: those that displacements join, ascending; nodes of `displacements` are the images of
/// the cluster, and so are `cams_from_world`, in the frame of the displacements. `least_scatter`:
/// by how much positions are known to scatter over what they state, 1 at least. nullopt: fewer than
/// 10 of them have a position, these spread by less than three sigmas of that scatter
/// (ScatterOfPositions), or less than 70 % come to lie within three.
[[nodiscard]] absl::StatusOr<std::optional<EnuPlacement>> PlaceInEnu(
    const ClusterProblem& problem,
    std::span<const ImageSlot> images,
    std::span<const Eigen::Quaterniond> cams_from_world,
    DifferenceGraph displacements,
    double least_scatter,
    const StageContext& context);

}  // namespace orbweave
