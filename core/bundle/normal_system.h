// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
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
  std::vector<Vector6> damping{};        ///< on the diagonal of S; zero before DampPoses
};

/// A system of zeros.
[[nodiscard]] NormalSystem MakeNormalSystem(SymmetricBlockMatrix zero);

/// Adds mu to the diagonal of S, once all terms are in, but for the retained blocks (empty: none):
/// mu = lambda x mean diagonal entry of each 3x3 block. Unlike Marquardt's diagonal it turns with
/// the world, so that the steps do too.
void DampPoses(double lambda, NormalSystem& system, const std::vector<uint8_t>& is_retained = {});

}  // namespace orbweave
