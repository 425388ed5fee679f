// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/bundle_state.h"

namespace orbweave {

BundleState InitialState(const BundleProblem& problem) {
  BundleState state;
  for (const Rigid3& cam_from_world : problem.cams_from_world) {
    state.poses.push_back(
        MakePoseState(cam_from_world.rotation.normalized(), cam_from_world.Centre()));
  }
  state.points = problem.points_in_world;
  state.biases.assign(problem.bias_sigma_m.size(), Eigen::Vector3d::Zero());
  return state;
}

}  // namespace orbweave
