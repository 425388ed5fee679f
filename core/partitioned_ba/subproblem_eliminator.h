// SPDX-FileCopyrightText: The Orbweave authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/bundle/bundle_eliminator.h"
#include "core/partitioned_ba/bundle_subproblem.h"
#include "core/partitioned_ba/separator_system.h"

namespace orbweave {

/// A subproblem's answer to a step of the separators.
struct SubproblemTrial {
  EvaluatedState state{};  ///< separator copies included
  TrialCost cost{};
};

/// A separator point that takes less than its whole step (see ChoosePointStep).
struct ShortenedPoint {
  uint32_t point = 0;  ///< in the whole problem
  double share = 0.0;

  friend bool operator==(const ShortenedPoint&, const ShortenedPoint&) = default;
};

/// The half-steps of one subproblem. Every subproblem moves its own copies of separators, from
/// equal values by equal arithmetic, so that copies stay equal bit for bit and nobody holds the
/// whole state. Structure is analysed once, in the constructor; results depend on the arguments
/// alone, so that another process may repeat any call with an object of its own. `subproblem`
/// outlives the object.
class SubproblemEliminator {
 public:
  SubproblemEliminator(const BundleSubproblem& subproblem,
                       const BundleOptions& options,
                       int num_threads);

  /// The subproblem's own poses and points. `cost.cost` is the subproblem's whole initial cost.
  [[nodiscard]] SubproblemTrial Start() const;

  /// Linearises at `state`, eliminates points and interior poses.
  [[nodiscard]] SeparatorSystem Linearise(const EvaluatedState& state, const StepControl& control);

  /// After Linearise at the same `state`; `step` is of the subproblem's separators.
  [[nodiscard]] SubproblemTrial BackSubstitute(const EvaluatedState& state,
                                               const SeparatorStep& step);

  /// The subproblem with `state`'s poses and points, scaled about the gauge's anchor.
  [[nodiscard]] BundleSubproblem Finish(const EvaluatedState& state, double scale) const;

  /// Distance that the gauge holds, 0 unless this subproblem has both ends of it.
  [[nodiscard]] double HeldDistance(const EvaluatedState& state) const;

 private:
  const BundleSubproblem& subproblem_;
  BundleEliminator eliminator_;
};

/// An accepted trial state with its shortened separator points (ascending) where they belong.
[[nodiscard]] EvaluatedState Accepted(const BundleSubproblem& subproblem,
                                      EvaluatedState trial,
                                      const std::vector<ShortenedPoint>& shortened);

}  // namespace orbweave
