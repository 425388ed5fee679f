// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/bundle/block_cholesky.h"
#include "core/bundle/normal_system.h"

namespace orbweave {

/// Eliminates from a normal system all blocks e but the retained ones k:
///   S_k' = S_kk - S_ke (S_ee + mu I)^-1 S_ek,   rhs_k' = rhs_k - S_ke (S_ee + mu I)^-1 rhs_e.
/// The structure is analysed once, in the constructor.
class BlockElimination {
 public:
  /// `is_retained` per block; empty: nothing is retained.
  BlockElimination(const SymmetricBlockMatrix& pattern, std::vector<uint8_t> is_retained);

  /// Damps and eliminates. False when the eliminated part is not positive definite; nothing else
  /// may be called then.
  [[nodiscard]] bool Eliminate(double lambda, NormalSystem& system);

  /// The system of the retained blocks, in their order, undamped.
  [[nodiscard]] NormalSystem Remaining(const NormalSystem& system) const;

  /// The whole step from that of the retained blocks (in their order).
  [[nodiscard]] std::vector<Vector6> BackSubstitute(
      const std::vector<Vector6>& retained_step) const;

  /// The eliminated blocks' part of the decrease that the linear model predicts for `step`.
  [[nodiscard]] double PredictedDecrease(const NormalSystem& system,
                                         const std::vector<Vector6>& step) const;

 private:
  std::vector<uint8_t> is_retained_{};
  std::vector<uint32_t> retained_{};  // blocks, ascending
  BlockCholesky cholesky_;
  std::vector<Vector6> forward_{};  // L^-1 rhs of the eliminated blocks, rhs' of the retained ones
};

}  // namespace orbweave
