// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "core/geometry/rigid3.h"

namespace orbweave {

/// `point` seen by `pose` along `bearing`.
struct BundleObservation {
  uint32_t pose = 0;
  uint32_t point = 0;
  Eigen::Vector3d bearing = Eigen::Vector3d::UnitZ();
  double sigma_rad = 1e-3;
};

/// Robust prior on a camera centre: |diag(1/sigma) (C + bias[group] - position)|^2 under a Cauchy
/// loss of loss_sigmas: 1 hardly heeds positions that are off; with several of them positions pull
/// back a street that has drifted off by as many sigmas. Cameras of one drive share a bias group;
/// no group, no bias. A height that nobody knows says nothing of how good others are
/// (PositionVarianceFactors).
struct PositionPrior {
  uint32_t pose = 0;
  Eigen::Vector3d position_in_world = Eigen::Vector3d::Zero();
  Eigen::Vector3d sigma_m = Eigen::Vector3d::Ones();
  double loss_sigmas = 1.0;
  std::optional<uint32_t> bias_group{};
  bool is_height_known = true;
};

/// Prior on a rotation: R direction_in_world should be direction_in_cam, both unit; the angle
/// between them over sigma, squared. With many cameras it says how a world stands upright.
struct DirectionPrior {
  uint32_t pose = 0;
  Eigen::Vector3d direction_in_world = -Eigen::Vector3d::UnitZ();
  Eigen::Vector3d direction_in_cam = Eigen::Vector3d::UnitY();
  double sigma_rad = 0.1;
};

/// What to solve: poses (R, C), points and bearings, all in one world frame.
struct BundleProblem {
  std::vector<Rigid3> cams_from_world{};
  std::vector<uint8_t> pose_is_fixed{};  ///< empty: none
  std::vector<Eigen::Vector3d> points_in_world{};
  std::vector<uint8_t> point_is_fixed{};  ///< empty: none
  std::vector<BundleObservation> observations{};
  std::vector<PositionPrior> position_priors{};
  std::vector<DirectionPrior> direction_priors{};
  /// Sigma of the (zero) prior on each bias group's bias; its size is the number of groups.
  std::vector<double> bias_sigma_m{};
};

/// InvalidArgument: an index out of range or a sigma that is not positive.
[[nodiscard]] absl::Status ValidateBundleProblem(const BundleProblem& problem);

}  // namespace orbweave
