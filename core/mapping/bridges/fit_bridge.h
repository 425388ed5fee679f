// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/geometry/rigid3.h"
#include "core/geometry/sim3.h"

namespace orbweave {

/// How two submodels a and b lie to each other, as one pair of their images has it.
struct PairTurn {
  Eigen::Quaterniond a_from_b = Eigen::Quaterniond::Identity();
  double sigma_rad = 1.0;
};

/// A camera of one submodel sees a point of the other along `bearing`, unit, in its own frame.
/// That point may be a camera of the other: then the bearing is the direction of the pair's
/// baseline.
struct BridgeSight {
  Rigid3 cam_from_own{};
  Eigen::Vector3d point_in_other = Eigen::Vector3d::Zero();
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  double sigma_rad = 1.0;
};

/// The GNSS position of a camera of b.
struct BridgeFix {
  Eigen::Vector3d centre_in_b = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
};

/// All that speaks for the place of submodel b in the frame of a.
struct BridgeTerms {
  std::vector<PairTurn> turns{};
  std::vector<BridgeSight> from_a{};  ///< cameras of a, points of b
  std::vector<BridgeSight> from_b{};  ///< cameras of b, points of a
  std::vector<BridgeFix> fixes{};
  Sim3 enu_from_a{};             ///< where there are fixes
  bool b_is_one_camera = false;  ///< whose scale nothing can tell, nor need
};

struct FittedBridge {
  Sim3 a_from_b{};
  double cost = 0.0;  ///< half sum of losses
  double log_scale_sigma = 0.0;
  /// Root of the largest eigenvalue of the covariance of the place, in units of a, where b's origin
  /// comes to lie.
  double translation_sigma = 0.0;
};

/// The similarity that fits all terms best, by Levenberg-Marquardt from `start`, each residual in
/// its own sigma under a Cauchy loss. With y = s Q x + t for a point x of b:
///   turn   log(Q Q_pair^T),
///   from a the tangent-plane difference between the ray R_i (y - C_i) and the bearing,
///   from b that between R_j (Q^T (P - t) - s C_j) and the bearing, P a point of a,
///   fix    enu_from_a y - position.
/// Sigmas come from the Gauss-Newton matrix at the end, with the weights of the loss.
[[nodiscard]] FittedBridge FitBridge(const BridgeTerms& terms, const Sim3& start);

/// Angle between each sight's ray and its bearing under a similarity, in its sigmas: those from a,
/// then those from b.
[[nodiscard]] std::vector<double> SightErrors(const BridgeTerms& terms, const Sim3& a_from_b);

}  // namespace orbweave
