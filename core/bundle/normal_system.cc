// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause

#include "core/bundle/normal_system.h"

#include <utility>

namespace orbweave {

NormalSystem MakeNormalSystem(SymmetricBlockMatrix zero) {
  NormalSystem system;
  system.rhs.assign(zero.num_blocks, Vector6::Zero());
  system.gradient = system.rhs;
  system.damping = system.rhs;
  system.trace.assign(zero.num_blocks, Eigen::Vector2d::Zero());
  system.S = std::move(zero);
  return system;
}

void DampPoses(double lambda, NormalSystem& system, const std::vector<uint8_t>& is_retained) {
  for (uint32_t block = 0; block < system.S.num_blocks; ++block) {
    if (!is_retained.empty() && is_retained[block]) continue;
    // A block that nothing observes has no gradient either: any positive number holds it.
    const Eigen::Vector2d& trace = system.trace[block];
    const double mu_rotation = trace[0] > 0.0 ? lambda * trace[0] / 3.0 : 1.0;
    const double mu_centre = trace[1] > 0.0 ? lambda * trace[1] / 3.0 : 1.0;
    system.damping[block] << Eigen::Vector3d::Constant(mu_rotation),
        Eigen::Vector3d::Constant(mu_centre);
    system.S.Diagonal(block).diagonal() += system.damping[block];
  }
}

}  // namespace orbweave
