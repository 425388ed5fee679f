// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bundle_problem.h"

#include <string>

#include "core/base/status.h"

namespace orbweave {
namespace {

absl::Status CheckIndex(const char* what, uint32_t index, size_t size) {
  if (index < size) return absl::OkStatus();
  return absl::InvalidArgumentError(std::string(what) + " " + std::to_string(index) +
                                    " is out of range, there are " + std::to_string(size));
}

absl::Status CheckFlags(const char* what, size_t size, size_t expected) {
  if (size == 0 || size == expected) return absl::OkStatus();
  return absl::InvalidArgumentError(std::string(what) + " has " + std::to_string(size) +
                                    " entries, expected " + std::to_string(expected) + " or none");
}

}  // namespace

absl::Status ValidateBundleProblem(const BundleProblem& problem) {
  const size_t num_poses = problem.cams_from_world.size();
  const size_t num_points = problem.points_in_world.size();
  ORBWEAVE_RETURN_IF_ERROR(CheckFlags("pose_is_fixed", problem.pose_is_fixed.size(), num_poses));
  ORBWEAVE_RETURN_IF_ERROR(CheckFlags("point_is_fixed", problem.point_is_fixed.size(), num_points));
  for (const BundleObservation& seen : problem.observations) {
    ORBWEAVE_RETURN_IF_ERROR(CheckIndex("pose", seen.pose, num_poses));
    ORBWEAVE_RETURN_IF_ERROR(CheckIndex("point", seen.point, num_points));
    if (!(seen.sigma_rad > 0.0)) return absl::InvalidArgumentError("sigma_rad must be positive");
  }
  for (const PositionPrior& prior : problem.position_priors) {
    ORBWEAVE_RETURN_IF_ERROR(CheckIndex("pose", prior.pose, num_poses));
    if (prior.bias_group) {
      ORBWEAVE_RETURN_IF_ERROR(
          CheckIndex("bias group", *prior.bias_group, problem.bias_sigma_m.size()));
    }
    if (!(prior.sigma_m.minCoeff() > 0.0)) {
      return absl::InvalidArgumentError("sigma_m must be positive");
    }
  }
  for (const DirectionPrior& prior : problem.direction_priors) {
    ORBWEAVE_RETURN_IF_ERROR(CheckIndex("pose", prior.pose, num_poses));
    if (!(prior.sigma_rad > 0.0)) return absl::InvalidArgumentError("sigma_rad must be positive");
  }
  return absl::OkStatus();
}

}  // namespace orbweave
