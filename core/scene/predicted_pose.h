// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "core/geometry/rigid3.h"
#include "core/scene/ids.h"

namespace orbweave {

/// What two pairs a-m and m-b say of the pair a-b without its matches: how the cameras are turned,
/// R_ba = R_bm R_ma, and between which two directions of a, seen from m's and those of a, b lies:
/// the baseline is x u + y v with positive lengths x and y that nobody knows.
struct PredictedPose {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< b_from_a
  Eigen::Vector3d first = Eigen::Vector3d::UnitX();              ///< u, unit: from a to m, in a
  Eigen::Vector3d last = Eigen::Vector3d::UnitX();               ///< v, unit: from m to b, in a

  /// By how much a pose is turned otherwise, and by how much its baseline leads past the arc from u
  /// to v, in radians.
  [[nodiscard]] double TurnedFrom(const Rigid3& b_from_a) const;
  [[nodiscard]] double LeadsPast(const Rigid3& b_from_a) const;
  /// Whether a rotation b_from_a, and a pose, are what the two pairs predict, as far as they know.
  [[nodiscard]] bool TurnsLike(const Eigen::Quaterniond& other) const;
  [[nodiscard]] bool AgreesWith(const Rigid3& b_from_a) const;
};

/// Of the pairs a-m and m-b. Both have a baseline.
[[nodiscard]] PredictedPose PredictPose(const Rigid3& m_from_a, const Rigid3& b_from_m);

/// A pair that was matched and not verified, and what others say of it.
struct PredictedPair {
  ImagePair pair{};
  PredictedPose pose{};
};

}  // namespace orbweave
