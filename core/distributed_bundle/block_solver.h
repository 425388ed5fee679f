// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/bundle/bundle_eliminator.h"
#include "core/distributed_bundle/adjustment_block.h"
#include "core/distributed_bundle/separator_system.h"

namespace orbweave {

/// A block's answer to a step of the separators.
struct BlockTrial {
  EvaluatedState state{};  ///< separator copies included
  TrialCost cost{};
};

/// A separator point that takes less than its whole step (see ChoosePointStep).
struct ShortenedPoint {
  uint32_t point = 0;  ///< in the whole problem
  double share = 0.0;

  friend bool operator==(const ShortenedPoint&, const ShortenedPoint&) = default;
};

/// The half-steps of one block. Every block moves its own copies of separators, from equal values
/// by equal arithmetic, so that copies stay equal bit for bit and nobody holds the whole state.
/// Structure is analysed once, in the constructor; results depend on the arguments alone, so that
/// another process may repeat any call with an object of its own. `block` outlives the object.
class BlockSolver {
 public:
  BlockSolver(const AdjustmentBlock& block, const BundleOptions& options, int num_threads);

  /// The block's own poses and points. `cost.cost` is the block's whole initial cost.
  [[nodiscard]] BlockTrial Start() const;

  /// Linearises at `state`, eliminates points and interior poses.
  [[nodiscard]] SeparatorSystem Linearize(const EvaluatedState& state, const StepControl& control);

  /// After Linearize at the same `state`; `step` is of the block's separators.
  [[nodiscard]] BlockTrial BackSubstitute(const EvaluatedState& state, const SeparatorStep& step);

  /// The block with `state`'s poses and points, scaled about the gauge's anchor.
  [[nodiscard]] AdjustmentBlock Finish(const EvaluatedState& state, double scale) const;

  /// Distance that the gauge holds, 0 unless this block has both ends of it.
  [[nodiscard]] double HeldDistance(const EvaluatedState& state) const;

 private:
  const AdjustmentBlock& block_;
  BundleEliminator eliminator_;
};

/// The two half-steps as pure functions: BackSubstituteBlock linearises again instead of holding
/// anything in between.
[[nodiscard]] SeparatorSystem LinearizeBlock(const AdjustmentBlock& block,
                                             const EvaluatedState& state,
                                             const StepControl& control,
                                             const BundleOptions& options,
                                             int num_threads);
[[nodiscard]] BlockTrial BackSubstituteBlock(const AdjustmentBlock& block,
                                             const EvaluatedState& state,
                                             const StepControl& control,
                                             const SeparatorStep& step,
                                             const BundleOptions& options,
                                             int num_threads);

/// An accepted trial state with its shortened separator points (ascending) where they belong.
[[nodiscard]] EvaluatedState Accepted(const AdjustmentBlock& block,
                                      EvaluatedState trial,
                                      const std::vector<ShortenedPoint>& shortened);

}  // namespace orbweave
