// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/bundle/bundle_problem.h"

namespace orbweave {

/// A pose (R, C); the matrix is kept beside the quaternion because every observation turns by it.
struct PoseState {
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d world_from_cam = Eigen::Matrix3d::Identity();
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
};

/// `rotation` is of unit length.
[[nodiscard]] inline PoseState MakePoseState(const Eigen::Quaterniond& rotation,
                                             const Eigen::Vector3d& centre) {
  return {rotation, rotation.conjugate().toRotationMatrix(), centre};
}

/// The variables of one solve, held ones included.
struct BundleState {
  std::vector<PoseState> poses{};
  std::vector<Eigen::Vector3d> points{};
  std::vector<Eigen::Vector3d> biases{};
};

/// The problem's poses and points; biases zero.
[[nodiscard]] BundleState InitialState(const BundleProblem& problem);

}  // namespace orbweave
