// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/bundle/block_matrix.h"

namespace orbweave {

/// Normal equations S step = rhs of 6x6 blocks from which other variables have been eliminated.
/// `gradient`, `trace` and `damping` are those of the full system. A block of three variables has
/// them last; its first three rows stand alone.
struct NormalSystem {
  SymmetricBlockMatrix S{};
  std::vector<Vector6> rhs{};
  std::vector<Vector6> gradient{};
  std::vector<Eigen::Vector2d> trace{};  ///< of the undamped diagonal: rotation, centre
  std::vector<Vector6> damping{};        ///< on the diagonal of S; zero before DampBlock
};

/// A system of zeros.
[[nodiscard]] inline NormalSystem MakeNormalSystem(SymmetricBlockMatrix zero) {
  NormalSystem system;
  system.rhs.assign(zero.num_blocks, Vector6::Zero());
  system.gradient = system.rhs;
  system.damping = system.rhs;
  system.trace.assign(zero.num_blocks, Eigen::Vector2d::Zero());
  system.S = std::move(zero);
  return system;
}

/// Adds mu to a diagonal block of S, once all terms are in: mu = lambda x mean diagonal entry of
/// each 3x3 block. Unlike Marquardt's diagonal it turns with the world, so that the steps do too.
inline void DampBlock(double lambda, uint32_t block, NormalSystem& system) {
  // A block that nothing observes has no gradient either: any positive number holds it.
  const Eigen::Vector2d& trace = system.trace[block];
  const double mu_rotation = trace[0] > 0.0 ? lambda * trace[0] / 3.0 : 1.0;
  const double mu_centre = trace[1] > 0.0 ? lambda * trace[1] / 3.0 : 1.0;
  system.damping[block] << Eigen::Vector3d::Constant(mu_rotation),
      Eigen::Vector3d::Constant(mu_centre);
  system.S.Diagonal(block).diagonal() += system.damping[block];
}

}  // namespace orbweave
