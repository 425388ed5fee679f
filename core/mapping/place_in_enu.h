// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <span>

#include "core/averaging/average_differences.h"
#include "core/mapping/correspondence_graph.h"

namespace orbweave {

/// Where images are.
struct EnuPlacement {
  /// How the frame of the displacements is turned.
  Eigen::Quaterniond enu_from_world = Eigen::Quaterniond::Identity();
  Eigen::MatrixXd centres{};  ///< a row per image of the cluster, in metres
};

/// Centres of images in east, north and up that agree with their displacements, which are in metres
/// but in a frame turned somehow, and with their GNSS positions. First the turn: so that most
/// displacements lie as between positions (Kabsch, reweighted); what is open of it about a straight
/// street has no effect on where images are. Then AverageDifferences with positions as differences
/// from the origin, horizontally and, for itself, up, where positions are less exact; displacements
/// are taken for good to a tenth of their length, more or less as their weights differ.
///
/// `images`: those that displacements join, ascending; nodes of `displacements` are the images of
/// the cluster. nullopt: fewer than 10 of them have a position, these spread by less than three
/// sigmas, or less than 70 % come to lie within three of theirs.
[[nodiscard]] absl::StatusOr<std::optional<EnuPlacement>> PlaceInEnu(
    const ClusterProblem& problem,
    std::span<const ImageSlot> images,
    DifferenceGraph displacements,
    const StageContext& context);

}  // namespace orbweave
